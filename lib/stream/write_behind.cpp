#include "write_behind.h"

#include "batch_queue.h"

namespace tetstream {

// Writes what waits. Throws what the sink threw.
class WriteBehind::Queue final : public BatchQueue {
 public:
  Queue(Sink& out, const Schema& schema, size_t most) : BatchQueue(schema, most), out_(out) {}

  void put(const BatchView& batch) {
    Lock lock(mutex_);
    waitUntil([this] { return !ring_.full(); }, lock);
    BatchCopy& last = ring_.last();  // at which nobody looks before it is counted
    lock.unlock();
    last.take(batch);
    lock.lock();
    ring_.countLast();
  }

  void settle() {
    Lock lock(mutex_);
    waitUntil([this] { return ring_.empty(); }, lock);
  }

 private:
  bool mayGoOn() const override { return !is_busy_ && !is_over_ && !error_ && !ring_.empty(); }

  template <class Condition>
  void waitUntil(Condition condition, Lock& lock) {
    goOnUntil([&] { return error_ || condition(); }, lock);
    if (error_) std::rethrow_exception(error_);
  }

  void goOn(Lock& lock) noexcept override {
    const BatchView batch = ring_.first().view();
    runBeside(lock, [&] { out_.put(batch); });
    ring_.dropFirst();
  }

  Sink& out_;
};

WriteBehind::WriteBehind(Sink& out, const Tasks& tasks) : out_(out), tasks_(tasks) {}

WriteBehind::~WriteBehind() {
  if (queue_) (*queue_)->close();
}

void WriteBehind::begin(const Schema& schema) {
  out_.begin(schema);
  queue_.emplace(new Queue(out_, schema, batchesBehind(tasks_.threads())));
}

void WriteBehind::put(const BatchView& batch) {
  if (++put_ <= kBatchesOfOneThread) return out_.put(batch);
  Queue& queue = *queue_->get();
  queue.put(batch);
  queue.ask(tasks_);
}

void WriteBehind::settle() {
  if (queue_) (*queue_)->settle();
}

void WriteBehind::finish() {
  settle();
  out_.finish();
}

}  // namespace tetstream
