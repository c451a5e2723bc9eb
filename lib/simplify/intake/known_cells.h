// simplify/intake: how far one thread is with the cells of the window, for another that follows.
// Depends on nothing.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace tetstream {

// Cells below the end are known. One thread moves it, up to a last end that the other knows of.
class KnownCells {
 public:
  explicit KnownCells(uint32_t end) : end_(end) {}

  void tell(uint32_t end) {
    const std::lock_guard lock(mutex_);
    end_ = end;
    told_.notify_one();
  }
  // Waits until a cell is known. Returns the end, which is behind it.
  uint32_t waitFor(uint32_t cell) {
    std::unique_lock lock(mutex_);
    told_.wait(lock, [this, cell] { return cell < end_; });
    return end_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable told_;
  uint32_t end_;
};

}  // namespace tetstream
