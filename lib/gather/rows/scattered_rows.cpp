#include "scattered_rows.h"

#include <algorithm>

namespace tetstream {

constexpr size_t kRunBytes = 1 << 16;

bool ScatteredRows::isNew(uint64_t row) {
  if (came_.empty() && row == given_) return true;
  if (came_.empty()) came_.assign(static_cast<size_t>(given_), true);
  if (row >= came_.size()) came_.resize(std::max(static_cast<size_t>(row) + 1, 2 * came_.size()));
  const bool is_new = !came_[static_cast<size_t>(row)];
  came_[static_cast<size_t>(row)] = true;
  return is_new;
}

void ScatteredRows::put(uint64_t row, const void* values) {
  if (row != next_ || run_.size() >= kRunBytes) {
    flush();
    run_first_ = row;
  }
  const auto* bytes = static_cast<const unsigned char*>(values);
  run_.insert(run_.end(), bytes, bytes + row_bytes_);
  next_ = row + 1;
  given_ += isNew(row);
}

void ScatteredRows::flush() {
  if (!run_.empty()) file_.writeAt(run_first_ * row_bytes_, run_.data(), run_.size());
  run_.clear();
}

void ScatteredRows::finish(uint64_t rows) {
  flush();
  const unsigned char zero = 0;
  if (rows > 0 && file_.size() < rows * row_bytes_) file_.writeAt(rows * row_bytes_ - 1, &zero, 1);
  run_ = {};
  came_ = {};
}

}  // namespace tetstream
