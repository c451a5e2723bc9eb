// stream: places for batches that wait. Depends on batch_copy.h.
#pragma once

#include <deque>

#include "batch_copy.h"

namespace tetstream {

// Beyond so many bytes no other batch is taken.
constexpr size_t kBytesOnTheWay = size_t{2} << 20;
// A stream of fewer batches is worth no other thread.
constexpr size_t kBatchesOfOneThread = 2;

// First in, first out. Not for several threads: its owner locks. What `last` gives may be filled
// without a lock, and what `first` gives looked at, until they are counted in or dropped.
class BatchRing {
 public:
  BatchRing(const Schema& schema, size_t most) : most_(most) {
    for (size_t i = 0; i < most; ++i) batches_.emplace_back(schema, account_);
  }
  bool empty() const { return count_ == 0; }
  bool full() const { return count_ == most_ || bytes_ >= kBytesOnTheWay; }
  BatchCopy& first() { return batches_[first_]; }
  void dropFirst() {
    bytes_ -= first().bytes();
    first_ = (first_ + 1) % most_;
    --count_;
  }
  BatchCopy& last() { return batches_[(first_ + count_) % most_]; }
  void countLast() {
    bytes_ += last().bytes();
    ++count_;
  }
  void clear() {
    batches_.clear();
    count_ = bytes_ = 0;
  }

 private:
  const size_t most_;
  Account account_;
  std::deque<BatchCopy> batches_;
  size_t first_ = 0, count_ = 0, bytes_ = 0;
};

}  // namespace tetstream
