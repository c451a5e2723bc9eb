#include "process.h"

#include <fcntl.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>

#include "failure.h"

namespace tetstream::cli {

// Signals that come within this time are one: `timeout` sends one to its child and then to the
// group that the child is in. What a run leaves is cleaned up in less; a person at a keyboard takes
// more.
constexpr uint32_t kOneSignalMs = 500;

// When the first signal came; 0: none has.
static std::atomic<uint32_t> g_first_signal = 0;
static_assert(decltype(g_first_signal)::is_always_lock_free);  // for a handler
// Per standard descriptor: one that refuses its direction of transfer and takes its place at a
// signal; -1: the descriptor stays.
static volatile sig_atomic_t g_refusing[2] = {-1, -1};

static int openRefusing(int standard_fd) {
  return ::open("/dev/null", (standard_fd == 0 ? O_WRONLY : O_RDONLY) | O_CLOEXEC);
}

// Milliseconds, which wrap, but are never 0.
static uint32_t now() {
  struct timespec time = {};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  const auto seconds = static_cast<uint32_t>(time.tv_sec);
  return (1000 * seconds + static_cast<uint32_t>(time.tv_nsec / 1000000)) | 1;
}

// Only calls that are allowed in handlers. The library restarts a transfer that a signal cut
// short; on the descriptor put in place here it fails instead.
extern "C" {
static void handleSignal(int) {
  const int saved = errno;
  uint32_t first = 0;
  const bool is_first = g_first_signal.compare_exchange_strong(first, now());
  if (!is_first && now() - first > kOneSignalMs) ::_exit(kCancelled);
  for (int fd = 0; fd < 2; ++fd)
    if (g_refusing[fd] >= 0) ::dup2(g_refusing[fd], fd);
  errno = saved;
}
}

void prepareProcess() {
  // A closed standard descriptor must not become a mesh file by accident.
  for (int fd = 0; fd < 3; ++fd)
    if (::fcntl(fd, F_GETFD) == -1) openRefusing(fd);
#ifdef __GLIBC__
  // Large arrays go back to the system when they are freed, not only the first ones: what a pilot
  // held is not held on top of the run that it serves.
  ::mallopt(M_MMAP_THRESHOLD, 128 << 10);
#endif
  // Broken pipes and files that grow beyond a limit are errors of write.
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old = {}, action = {};
    if (::sigaction(number, nullptr, &old) == 0 && old.sa_handler == SIG_IGN) continue;
    action.sa_handler = handleSignal;  // no SA_RESTART: waiting calls return
    ::sigemptyset(&action.sa_mask);
    ::sigaction(number, &action, nullptr);
  }
}

bool interrupted() {
  return g_first_signal != 0;
}

void interruptTransfersOf(int standard_fd) {
  g_refusing[standard_fd] = openRefusing(standard_fd);
  // A signal that came before did not find it.
  if (interrupted() && g_refusing[standard_fd] >= 0) ::dup2(g_refusing[standard_fd], standard_fd);
}

}  // namespace tetstream::cli
