#include "write_behind.h"

#include <condition_variable>
#include <exception>
#include <mutex>

#include "batch_ring.h"

namespace tetstream {

// As a piece of work: writes what waits. One that comes late finds nothing.
class WriteBehind::Queue final : public Work {
 public:
  Queue(Sink& out, const Schema& schema) : out_(out), ring_(schema, kBatchesBehind) {}

  void run() noexcept override {
    std::unique_lock<std::mutex> lock(mutex_);
    is_asked_ = false;
    while (mayWrite()) writeFirst(lock);
  }

  void put(const BatchView& batch) {
    std::unique_lock<std::mutex> lock(mutex_);
    waitUntil([this] { return !ring_.full(); }, lock);
    BatchCopy& last = ring_.last();  // at which nobody looks before it is counted
    lock.unlock();
    last.take(batch);
    lock.lock();
    ring_.countLast();
  }

  void settle() {
    std::unique_lock<std::mutex> lock(mutex_);
    waitUntil([this] { return ring_.empty(); }, lock);
  }

  // Whether somebody is to be asked to write, who is expected from then on.
  bool ask() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const bool should = !is_asked_ && mayWrite();
    is_asked_ = is_asked_ || should;
    return should;
  }
  void countRefused() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_asked_ = false;
  }

  void close() {
    std::unique_lock<std::mutex> lock(mutex_);
    is_closed_ = true;
    written_.wait(lock, [this] { return !is_writing_; });
    ring_.clear();
  }

 private:
  bool mayWrite() const { return !is_writing_ && !is_closed_ && !error_ && !ring_.empty(); }

  // Throws what the sink threw. What nobody else writes, the caller does.
  template <class Condition>
  void waitUntil(Condition condition, std::unique_lock<std::mutex>& lock) {
    while (!error_ && !condition())
      if (is_writing_)
        written_.wait(lock);
      else
        writeFirst(lock);
    if (error_) std::rethrow_exception(error_);
  }

  // With the mutex held, but not while it writes.
  void writeFirst(std::unique_lock<std::mutex>& lock) noexcept {
    is_writing_ = true;
    const BatchView batch = ring_.first().view();
    lock.unlock();
    std::exception_ptr error;
    try {
      out_.put(batch);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    is_writing_ = false;
    error_ = error;
    ring_.dropFirst();
    written_.notify_all();
  }

  Sink& out_;
  std::mutex mutex_;
  std::condition_variable written_;
  BatchRing ring_;
  bool is_asked_ = false, is_writing_ = false, is_closed_ = false;
  std::exception_ptr error_;
};

WriteBehind::WriteBehind(Sink& out, const Tasks& tasks) : out_(out), tasks_(tasks) {}

WriteBehind::~WriteBehind() {
  if (queue_) (*queue_)->close();
}

void WriteBehind::begin(const Schema& schema) {
  out_.begin(schema);
  queue_.emplace(new Queue(out_, schema));
}

void WriteBehind::put(const BatchView& batch) {
  if (++put_ <= kBatchesOfOneThread) return out_.put(batch);
  Queue& queue = *queue_->get();
  queue.put(batch);
  if (queue.ask() && !tasks_.submit(&queue)) queue.countRefused();
}

void WriteBehind::settle() {
  if (queue_) (*queue_)->settle();
}

void WriteBehind::finish() {
  settle();
  out_.finish();
}

}  // namespace tetstream
