// base: waiting for another thread. Depends on processor.h.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "processor.h"

namespace tetstream {

// Waits until the condition, which is looked at with the lock, holds. What takes the other one less
// than to put this thread to sleep and wake it is waited for awake.
template <class Condition>
void waitBriefly(std::condition_variable& changed, std::unique_lock<std::mutex>& lock,
                 Condition condition) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kAwake = std::chrono::microseconds(20);
  if (condition()) return;
  for (const auto end = Clock::now() + kAwake; Clock::now() < end;) {
    lock.unlock();
    for (int i = 0; i < 8; ++i) restBriefly();
    lock.lock();
    if (condition()) return;
  }
  changed.wait(lock, condition);
}

}  // namespace tetstream
