#include "read_ahead.h"

#include <condition_variable>
#include <exception>
#include <mutex>

#include "batch_ring.h"

namespace tetstream {

// As a piece of work: reads as many batches as may wait. One that comes late finds the queue
// closed.
class ReadAhead::Queue final : public Work {
 public:
  explicit Queue(Source& in) : in_(in), ring_(in.schema(), kBatchesAhead) {}

  void run() noexcept override {
    std::unique_lock<std::mutex> lock(mutex_);
    is_asked_ = false;
    while (mayRead()) readOne(lock);
  }

  // Returns whether there was one.
  bool next(BatchView& batch) {
    std::unique_lock<std::mutex> lock(mutex_);
    if (handed_out_) ring_.dropFirst();
    handed_out_ = false;
    while (ring_.empty() && !is_over_)
      if (is_reading_)
        read_.wait(lock);
      else
        readOne(lock);
    if (ring_.empty()) {
      if (error_) std::rethrow_exception(error_);
      return false;
    }
    handed_out_ = true;
    batch = ring_.first().view();
    return true;
  }

  // Whether somebody is to be asked to read, who is expected from then on.
  bool ask() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const bool should = !is_asked_ && mayRead();
    is_asked_ = is_asked_ || should;
    return should;
  }
  void countRefused() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_asked_ = false;
  }

  void close() {
    std::unique_lock<std::mutex> lock(mutex_);
    is_over_ = true;
    read_.wait(lock, [this] { return !is_reading_; });
    ring_.clear();
  }

 private:
  bool mayRead() const { return !is_reading_ && !is_over_ && !ring_.full(); }

  // With the mutex held, but not while it reads.
  void readOne(std::unique_lock<std::mutex>& lock) noexcept {
    BatchCopy& batch = ring_.last();
    is_reading_ = true;
    lock.unlock();
    bool more = false;
    std::exception_ptr error;
    try {
      BatchView view;
      more = in_.next(view);
      if (more) batch.take(view);
    } catch (...) {
      more = false;
      error = std::current_exception();
    }
    lock.lock();
    is_reading_ = false;
    if (more)
      ring_.countLast();
    else
      is_over_ = true;
    error_ = error;
    read_.notify_all();
  }

  Source& in_;
  std::mutex mutex_;
  std::condition_variable read_;
  BatchRing ring_;
  bool is_asked_ = false, is_reading_ = false, is_over_ = false, handed_out_ = false;
  std::exception_ptr error_;  // in place of the next batch
};

ReadAhead::ReadAhead(Source& in, const Tasks& tasks)
    : tasks_(tasks), schema_(in.schema()), queue_(new Queue(in)) {}

ReadAhead::~ReadAhead() {
  queue_->close();
}

bool ReadAhead::next(BatchView& batch) {
  if (!queue_->next(batch)) return false;
  if (++asked_ > kBatchesOfOneThread && queue_->ask() && !tasks_.submit(queue_.get()))
    queue_->countRefused();
  return true;
}

}  // namespace tetstream
