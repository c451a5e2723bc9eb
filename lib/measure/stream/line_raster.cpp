#include "line_raster.h"

#include <algorithm>

namespace tetstream {

// How many fall on each of `places`, so that `count` have room; one if the count is not known.
static uint64_t perPlace(int64_t count, size_t places) {
  return count > 0 ? (static_cast<uint64_t>(count) + places - 1) / places : 1;
}

// note: a line may end where the last column does, which is the start of one more; what that one
// lacks to a whole goes to yet another.
LineRaster::LineRaster(Account& account, size_t columns, size_t rows, int64_t times, int64_t lines)
    : columns_(columns),
      rows_(rows),
      stride_(columns + 2),
      column_width_(perPlace(times, columns)),
      row_height_(perPlace(lines, rows)),
      covered_(account, checkedMultiply(rows, columns + 2)),
      open_(account, rows) {
  std::fill_n(covered_.data(), covered_.size(), 0);
  std::fill_n(open_.data(), open_.size(), 0);
}

void LineRaster::goTo(uint64_t time) {
  time_ = time;
  for (; time >= column_start_ + column_width_; column_start_ += column_width_) ++column_;
}

void LineRaster::add(size_t r, int64_t count) {
  const int64_t before = static_cast<int64_t>(time_ - column_start_);
  int64_t* at = row(r) + column_;
  at[0] += count * (static_cast<int64_t>(column_width_) - before);
  at[1] += count * before;
  open_[r] += count;
}

void LineRaster::start(uint64_t line, uint64_t time) {
  while (line >= rows_ * row_height_) halveRows();
  goTo(time);
  add(line / row_height_, 1);
}

void LineRaster::end(uint64_t line, uint64_t time) {
  goTo(time);
  add(line / row_height_, -1);
}

void LineRaster::endAll(uint64_t time) {
  goTo(time);
  for (size_t r = 0; r < rows_; ++r) add(r, -open_[r]);
}

// Two columns are covered by the sum of what they were; past the last one, by what goes on.
static void halveRow(int64_t* steps, size_t size) {
  int64_t covered = 0, pair_before = 0;
  for (size_t i = 0; 2 * i < size + 2; ++i) {
    int64_t pair = 0;
    for (size_t j = 2 * i; j < 2 * i + 2; ++j) {
      if (j < size) covered += steps[j];
      pair += covered;
    }
    if (i < size) steps[i] = pair - pair_before;
    pair_before = pair;
  }
  for (size_t i = size / 2 + 1; i < size; ++i) steps[i] = 0;
}

void LineRaster::halveColumns() {
  for (size_t r = 0; r < rows_; ++r) halveRow(row(r), stride_);
  column_width_ *= 2;
  column_ /= 2;
  column_start_ = column_ * column_width_;
}

// Row r takes the place of 2 r and 2 r + 1, which are not below it.
void LineRaster::halveRows() {
  for (size_t r = 0; r < rows_; ++r) {
    if (r > 0) std::fill_n(row(r), stride_, 0);
    if (r > 0) open_[r] = 0;
    for (size_t from = r > 0 ? 2 * r : 1; from < 2 * r + 2 && from < rows_; ++from) {
      for (size_t i = 0; i < stride_; ++i) row(r)[i] += row(from)[i];
      open_[r] += open_[from];
    }
  }
  row_height_ *= 2;
}

void LineRaster::coverage(uint64_t times, uint64_t lines, float* out) const {
  const size_t columns = columnsUsed(times), rows = rowsUsed(lines);
  for (size_t r = 0; r < rows; ++r) {
    const uint64_t height = std::min(row_height_, lines - r * row_height_);
    int64_t covered = 0;
    for (size_t c = 0; c < columns; ++c) {
      const uint64_t width = std::min(column_width_, times - c * column_width_);
      covered += row(r)[c];
      out[r * columns + c] =
          static_cast<float>(static_cast<double>(covered) / (static_cast<double>(width * height)));
    }
  }
}

}  // namespace tetstream
