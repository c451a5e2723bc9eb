#include "read_ahead.h"

#include <utility>

#include "batch_queue.h"

namespace tetstream {

// Reads as many batches as may wait.
class ReadAhead::Queue final : public BatchQueue {
 public:
  explicit Queue(Source& in) : BatchQueue(in.schema(), kBatchesAhead), in_(in) {}

  // Returns whether there was one. What the source threw comes in place of the next batch.
  // `waiting` may be null.
  bool next(BatchView& batch, const Waiting* waiting) {
    Lock lock(mutex_);
    if (handed_out_) ring_.dropFirst();
    handed_out_ = false;
    const auto hasCome = [this] { return !ring_.empty() || is_over_; };
    waiting ? goOnUntil(hasCome, lock, *waiting) : goOnUntil(hasCome, lock);
    if (ring_.empty()) {
      if (error_) std::rethrow_exception(error_);
      return false;
    }
    handed_out_ = true;
    batch = ring_.first().view();
    return true;
  }

 private:
  bool mayGoOn() const override { return !is_busy_ && !is_over_ && !ring_.full(); }

  void goOn(Lock& lock) noexcept override {
    BatchCopy& batch = ring_.last();
    bool more = false;
    runBeside(lock, [&] {
      BatchView view;
      if (!in_.next(view)) return;
      batch.take(view);
      more = true;
    });
    if (more)
      ring_.countLast();
    else
      is_over_ = true;
  }

  Source& in_;
  bool handed_out_ = false;
};

ReadAhead::ReadAhead(Source& in, const Tasks& tasks)
    : tasks_(tasks), schema_(in.schema()), queue_(new Queue(in)) {}

ReadAhead::ReadAhead(Source& in, std::shared_ptr<Waiting> waiting)
    : waiting_(std::move(waiting)),
      own_(2),
      tasks_(*own_),
      schema_(in.schema()),
      queue_(new Queue(in)) {}

ReadAhead::~ReadAhead() {
  if (waiting_) waiting_->end();
  queue_->close();
}

bool ReadAhead::next(BatchView& batch) {
  if (!queue_->next(batch, waiting_.get())) return false;
  if (++asked_ > kBatchesOfOneThread) queue_->ask(tasks_);
  return true;
}

}  // namespace tetstream
