// base: work that is done while a lock is open.
#pragma once

#include <exception>
#include <mutex>

namespace tetstream {

// Does the work without the lock, which is held before and after; returns what it threw.
template <class Work>
std::exception_ptr doUnlocked(std::unique_lock<std::mutex>& lock, Work&& work) noexcept {
  lock.unlock();
  std::exception_ptr error;
  try {
    work();
  } catch (...) {
    error = std::current_exception();
  }
  lock.lock();
  return error;
}

}  // namespace tetstream
