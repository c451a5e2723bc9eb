// gather/pieces: integers of an array in sequence, some thousands read at once. Depends on
// mesh_pieces.h.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "mesh_pieces.h"

namespace tetstream {

class IntegerWindow {
 public:
  static constexpr size_t kMost = 2048;

  IntegerWindow(const MeshArray& array, uint64_t count)
      : values_(count > 0 ? array.open(count) : nullptr), count_(count), held_(kMost) {}
  uint64_t count() const { return count_; }
  // `n` values, at most kMost, from `first` on, which never goes back: they live until the next
  // call. There must be so many.
  const int64_t* at(uint64_t first, size_t n) {
    if (first + n > begin_ + filled_) {
      begin_ = first;
      filled_ = static_cast<size_t>(std::min<uint64_t>(kMost, count_ - first));
      values_->read(first, filled_, held_.data(), ScalarType::kInt64);
    }
    return held_.data() + (first - begin_);
  }
  // One after the other.
  bool hasEnded() const { return next_ == count_; }
  int64_t next() { return *at(next_++, 1); }

 private:
  std::unique_ptr<Values> values_;
  uint64_t count_, begin_ = 0, next_ = 0;
  size_t filled_ = 0;
  std::vector<int64_t> held_;
};

}  // namespace tetstream
