#include "scattered_rows.h"

namespace tetstream {

constexpr size_t kRunBytes = 1 << 16;

void ScatteredRows::put(uint64_t row, const void* values) {
  if (row != next_ || run_.size() >= kRunBytes) {
    flush();
    run_first_ = row;
  }
  const auto* bytes = static_cast<const unsigned char*>(values);
  run_.insert(run_.end(), bytes, bytes + row_bytes_);
  next_ = row + 1;
  ++given_;
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
}

}  // namespace tetstream
