// stream: the rows of a table that nothing is in. Depends on base.
#pragma once

#include "memory.h"

namespace tetstream {

// The row that was given back last is taken first. The table has twice as many when all are taken.
class FreeRows {
 public:
  explicit FreeRows(Account& account) : free_(account) {}

  size_t rows() const { return rows_; }
  // resize(rows) makes the table as long, or throws.
  template <class Resize>
  uint32_t take(Resize resize) {
    if (count_ == 0) grow(resize);
    return free_[--count_];
  }
  void giveBack(uint32_t row) { free_[count_++] = row; }

 private:
  static constexpr size_t kFirstRows = 256;

  template <class Resize>
  [[gnu::noinline]] void grow(Resize resize) {
    const size_t rows = rows_ > 0 ? 2 * rows_ : kFirstRows;
    resize(rows);
    free_.resize(rows);
    for (size_t row = rows; row-- > rows_;) giveBack(static_cast<uint32_t>(row));
    rows_ = rows;
  }

  Array<uint32_t> free_;
  size_t rows_ = 0, count_ = 0;
};

}  // namespace tetstream
