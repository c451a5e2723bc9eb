// gather/rows: a set of points, in a bit each. Depends on memory.h.
#pragma once

#include <algorithm>

#include "memory.h"

namespace tetstream {

class PointSet {
 public:
  PointSet(Account& account, uint64_t points)
      : words_(account, static_cast<size_t>(points / 64 + 1)) {
    std::fill_n(words_.data(), words_.size(), uint64_t{0});
  }

  bool has(uint64_t point) const { return (words_[wordOf(point)] & bitOf(point)) != 0; }
  // Whether it was not there yet.
  bool add(uint64_t point) {
    const bool is_new = !has(point);
    words_[wordOf(point)] |= bitOf(point);
    return is_new;
  }
  // Whether it was there.
  bool remove(uint64_t point) {
    const bool was_there = has(point);
    words_[wordOf(point)] &= ~bitOf(point);
    return was_there;
  }

 private:
  static size_t wordOf(uint64_t point) { return static_cast<size_t>(point / 64); }
  static uint64_t bitOf(uint64_t point) { return uint64_t{1} << (point % 64); }
  Array<uint64_t> words_;
};

}  // namespace tetstream
