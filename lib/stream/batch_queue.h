// stream: batches on their way to or from a thread that goes on with them. Depends on batch_ring.h,
// tasks.h, unlocked.h, waiting.h.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>

#include "batch_ring.h"
#include "tasks.h"
#include "unlocked.h"
#include "wait_briefly.h"
#include "waiting.h"

namespace tetstream {

// run() goes on as long as it may, on a helper's thread; if it comes late the queue is closed. At
// most one thread at a time goes on, and at most one more is expected to.
class BatchQueue : public Work {
 public:
  BatchQueue(const Schema& schema, size_t most) : ring_(schema, most) {}

  void run() noexcept final {
    Lock lock(mutex_);
    is_asked_ = false;
    while (mayGoOn()) goOn(lock);
  }
  // Asks a thread to go on, unless one is expected or there is nothing to do.
  void ask(const Tasks& tasks);
  // Waits for the batch that is being worked on, and drops the others.
  void close();

 protected:
  using Lock = std::unique_lock<std::mutex>;
  // These with the mutex held.
  virtual bool mayGoOn() const = 0;
  virtual void goOn(Lock& lock) noexcept = 0;
  // Runs `work` with the mutex open, and keeps what it throws.
  template <class Beside>
  void runBeside(Lock& lock, Beside work) noexcept {
    is_busy_ = true;
    error_ = doUnlocked(lock, work);
    is_busy_ = false;
    changed_.notify_all();
  }
  // Nobody else does what this thread waits for: it does it itself.
  template <class Condition>
  void goOnUntil(Condition condition, Lock& lock) noexcept {
    while (!condition())
      if (is_busy_)
        waitBriefly(changed_, lock, [&] { return !is_busy_ || condition(); });
      else
        goOn(lock);
  }
  // The same, with somebody at the other end.
  template <class Condition>
  void goOnUntil(Condition condition, Lock& lock, const Waiting& waiting) {
    constexpr auto kPart = std::chrono::milliseconds(Waiting::kMilliseconds);
    while (!condition())
      if (!is_busy_)
        goOn(lock);
      else if (!changed_.wait_for(lock, kPart, [&] { return !is_busy_ || condition(); }))
        if (std::exception_ptr error = doUnlocked(lock, [&] { waiting.meanwhile(); }))
          std::rethrow_exception(error);
  }

  std::mutex mutex_;
  BatchRing ring_;
  bool is_busy_ = false, is_over_ = false;
  std::exception_ptr error_;

 private:
  std::condition_variable changed_;
  bool is_asked_ = false;
};

}  // namespace tetstream
