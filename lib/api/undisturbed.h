// api: a thread works as it would in a program of our own. Depends on nothing.
#pragma once

#include <pthread.h>

#include <cfenv>

namespace tetstream {

// While this lives, cancelling the thread waits, and its arithmetic is what every program begins
// with: nothing traps or is flushed to zero, and rounding is to nearest. Solvers may have it
// otherwise, and have it again afterwards, with the exceptions that they had raised and no others.
// glibc unwinds a cancelled thread by an exception that may not be kept, as all others are at the
// boundary, nor leave a destructor; so of a thread whose cancellation is asynchronous nothing can
// be promised.
// note: systems without cancellation lack the macro.
class Undisturbed {
 public:
  Undisturbed() noexcept {
#ifdef PTHREAD_CANCEL_DISABLE
    ::pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &cancellation_);
#endif
    std::fegetenv(&arithmetic_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~Undisturbed() {
    std::fesetenv(&arithmetic_);
#ifdef PTHREAD_CANCEL_DISABLE
    ::pthread_setcancelstate(cancellation_, nullptr);
#endif
  }
  Undisturbed(const Undisturbed&) = delete;
  Undisturbed& operator=(const Undisturbed&) = delete;

 private:
  [[maybe_unused]] int cancellation_ = 0;
  std::fenv_t arithmetic_;
};

}  // namespace tetstream
