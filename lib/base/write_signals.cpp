#include "write_signals.h"

#include <cerrno>
#include <ctime>

namespace tetstream {

static constexpr int kSignals[] = {SIGPIPE, SIGXFSZ};

WriteSignalsHeld::WriteSignalsHeld() noexcept {
  sigemptyset(&held_);
  for (int number : kSignals) sigaddset(&held_, number);
  sigemptyset(&before_);
  sigpending(&before_);
  pthread_sigmask(SIG_BLOCK, &held_, &mask_);
}

// What came since, if nobody ignores it, is taken away: it has been told by errno.
WriteSignalsHeld::~WriteSignalsHeld() {
  const int saved = errno;
  sigset_t now;
  sigemptyset(&now);
  sigpending(&now);
  for (int number : kSignals) {
    if (sigismember(&now, number) != 1 || sigismember(&before_, number) == 1) continue;
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, number);
    const struct timespec no_time = {};  // another thread may have taken one sent to the process
    sigtimedwait(&one, nullptr, &no_time);
  }
  pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  errno = saved;
}

}  // namespace tetstream
