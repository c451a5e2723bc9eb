#include "process.h"

#include <fcntl.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <signal.h>
#include <unistd.h>

#include <cerrno>

#include "failure.h"

namespace tetstream::cli {

static volatile sig_atomic_t g_signals = 0;
// Per standard descriptor: one that refuses its direction of transfer and takes its place at a
// signal; -1: the descriptor stays.
static volatile sig_atomic_t g_refusing[2] = {-1, -1};

static int openRefusing(int standard_fd) {
  return ::open("/dev/null", (standard_fd == 0 ? O_WRONLY : O_RDONLY) | O_CLOEXEC);
}

// Only calls that are allowed in handlers. The library restarts a transfer that a signal cut
// short; on the descriptor put in place here it fails instead.
extern "C" {
static void handleSignal(int) {
  const int saved = errno;
  if (g_signals > 0) ::_exit(kCancelled);
  g_signals = 1;
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
  return g_signals > 0;
}

void interruptTransfersOf(int standard_fd) {
  g_refusing[standard_fd] = openRefusing(standard_fd);
  // A signal that came before did not find it.
  if (interrupted() && g_refusing[standard_fd] >= 0) ::dup2(g_refusing[standard_fd], standard_fd);
}

}  // namespace tetstream::cli
