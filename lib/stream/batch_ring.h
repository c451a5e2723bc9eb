// stream: batches on their way from one thread to another. Depends on batch_copy.h.
#pragma once

#include <deque>

#include "batch_copy.h"

namespace tetstream {

// Batches that may wait at once, of kBatchCells 1.2 MB, and bytes beyond which no other is taken.
constexpr size_t kBatchesOnTheWay = 8;
constexpr size_t kBytesOnTheWay = size_t{2} << 20;
// A stream of fewer batches is worth no other thread.
constexpr size_t kBatchesOfOneThread = 2;

// First in, first out. Not for several threads: its owner locks. What `last` gives may be filled
// without a lock, and what `first` gives looked at, until they are counted in or dropped.
class BatchRing {
 public:
  explicit BatchRing(const Schema& schema) {
    for (size_t i = 0; i < kBatchesOnTheWay; ++i) batches_.emplace_back(schema, account_);
  }
  bool empty() const { return count_ == 0; }
  bool full() const { return count_ == kBatchesOnTheWay || bytes_ >= kBytesOnTheWay; }
  BatchCopy& first() { return batches_[first_]; }
  void dropFirst() {
    bytes_ -= first().bytes();
    first_ = (first_ + 1) % kBatchesOnTheWay;
    --count_;
  }
  BatchCopy& last() { return batches_[(first_ + count_) % kBatchesOnTheWay]; }
  void countLast() {
    bytes_ += last().bytes();
    ++count_;
  }
  void clear() {
    batches_.clear();
    count_ = bytes_ = 0;
  }

 private:
  Account account_;
  std::deque<BatchCopy> batches_;
  size_t first_ = 0, count_ = 0, bytes_ = 0;
};

}  // namespace tetstream
