// api: a thread that is cancelled ends outside of the library. Depends on nothing.
#pragma once

#include <pthread.h>

namespace tetstream {

// While this lives, cancelling the thread waits. glibc unwinds a cancelled thread by an exception
// that may not be kept, as all others are at the boundary, nor leave a destructor; so of a thread
// whose cancellation is asynchronous nothing can be promised.
// note: systems without cancellation lack the macro.
class Uncancelled {
 public:
#ifdef PTHREAD_CANCEL_DISABLE
  Uncancelled() noexcept {
    ::pthread_setcancelstate(PTHREAD_CANCEL_DISABLE, &before_);
  }
  ~Uncancelled() {
    ::pthread_setcancelstate(before_, nullptr);
  }
#else
  Uncancelled() noexcept {}
  ~Uncancelled() {}
#endif
  Uncancelled(const Uncancelled&) = delete;
  Uncancelled& operator=(const Uncancelled&) = delete;

 private:
  [[maybe_unused]] int before_ = 0;
};

}  // namespace tetstream
