// measure/stream: horizontal lines of any number, drawn into a raster of fixed size. Depends on
// base.
//
// Line v runs from start(v, a) to end(v, b): it covers [a, b) on the axis of time. The raster holds
// how much of each of its places is covered. It is told nothing beforehand that must be true: where
// time or lines go past its edge, pairs of columns or of rows become one.
//
// A line's start adds to its row what it covers of its column, and to the next column what is
// missing there to a whole one; an end takes the same away. So the running sum along a row is what
// is covered of each column, and a line that is not ended goes on to the edge.
#pragma once

#include "memory.h"

namespace tetstream {

class LineRaster {
 public:
  // `times` and `lines`: how many are expected, or -1.
  LineRaster(Account& account, size_t columns, size_t rows, int64_t times, int64_t lines);

  // Whether a line may start or end at `time`, or the columns must be halved first.
  bool reaches(uint64_t time) const { return time <= columns_ * column_width_; }
  void halveColumns();

  // Times never fall; lines are numbered from 0 and start in any order.
  void start(uint64_t line, uint64_t time);
  void end(uint64_t line, uint64_t time);
  // All lines that have not ended do so.
  void endAll(uint64_t time);

  size_t columns() const { return columns_; }
  uint64_t columnWidth() const { return column_width_; }
  uint64_t rowHeight() const { return row_height_; }
  // The column of the last time.
  size_t column() const { return column_; }

  // After endAll: what is covered of the places of the first `times` times and `lines` lines, 0 to
  // 1, row by row, as far as there are such.
  size_t columnsUsed(uint64_t times) const { return (times + column_width_ - 1) / column_width_; }
  size_t rowsUsed(uint64_t lines) const { return (lines + row_height_ - 1) / row_height_; }
  void coverage(uint64_t times, uint64_t lines, float* out) const;

 private:
  int64_t* row(size_t r) { return covered_.data() + r * stride_; }
  const int64_t* row(size_t r) const { return covered_.data() + r * stride_; }
  void goTo(uint64_t time);
  void add(size_t r, int64_t count);
  void halveRows();

  size_t columns_, rows_, stride_;
  uint64_t column_width_, row_height_;  // times in a column, lines in a row
  size_t column_ = 0;
  uint64_t column_start_ = 0, time_ = 0;
  Array<int64_t> covered_;  // the steps from column to column
  Array<int64_t> open_;     // per row: lines that have not ended
};

}  // namespace tetstream
