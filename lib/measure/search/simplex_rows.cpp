#include "simplex_rows.h"

#include <algorithm>
#include <limits>

namespace tetstream {

constexpr size_t kFirstRows = 256;
// Of a file two blocks are held; with smaller ones many files fit a small memory.
constexpr size_t kSmallestBlock = 16 << 10, kLargestBlock = 256 << 10, kBlocksOfMemory = 256;

Box::Box() {
  std::fill_n(low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
}

void Box::add(const double place[3]) {
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], place[k]);
    high[k] = std::max(high[k], place[k]);
  }
}

// Of nothing, too, which changes nothing.
void Box::add(const Box& other) {
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], other.low[k]);
    high[k] = std::max(high[k], other.high[k]);
  }
}

Box RowShape::boxOf(const double* row) const {
  Box box;
  for (size_t c = 0; c < corners; ++c) box.add(place(row, c));
  return box;
}

void RowShape::centreOf(const double* row, double out[3]) const {
  for (size_t k = 0; k < 3; ++k) {
    out[k] = 0;
    for (size_t c = 0; c < corners; ++c) out[k] += place(row, c)[k] / static_cast<double>(corners);
  }
}

SimplexRows::SimplexRows(RowShape shape, const RowBudget& budget)
    : shape_(shape), budget_(budget), rows_(budget.account) {}

// What is in core goes to a file, and so does what comes later.
void SimplexRows::spill() {
  const size_t block =
      std::clamp(budget_.in_core_bytes / kBlocksOfMemory, kSmallestBlock, kLargestBlock);
  spool_ = std::make_unique<RowSpool>(shape_.doubles() * sizeof(double), budget_.temp_dir,
                                      SpoolShape{2, block});
  spool_->append(rows_.data(), static_cast<size_t>(count_));
  rows_.resize(0);
}

void SimplexRows::add(const double* row) {
  const size_t doubles = shape_.doubles();
  double centre[3];
  shape_.centreOf(row, centre);
  centres_.add(centre);
  box_.add(shape_.boxOf(row));
  const size_t most = std::max<size_t>(budget_.in_core_bytes / sizeof(double) / doubles, 1);
  if (!spool_ && count_ == most) spill();
  if (spool_) {
    spool_->append(row, 1);
    ++count_;
    return;
  }
  const auto at = static_cast<size_t>(count_) * doubles;
  if (at == rows_.size()) {
    const auto rows = static_cast<size_t>(count_);
    rows_.resize(doubles * std::min(most, std::max(kFirstRows, rows + rows / 2)));
  }
  std::copy_n(row, doubles, rows_.data() + at);
  ++count_;
}

void SimplexRows::finish() {
  if (spool_) spool_->finish();
}

const double* SimplexRows::row(uint64_t index) {
  if (spool_) return static_cast<const double*>(spool_->row(index));
  return rows_.data() + static_cast<size_t>(index) * shape_.doubles();
}

}  // namespace tetstream
