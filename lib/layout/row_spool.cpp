#include "row_spool.h"

#include <algorithm>

namespace tetstream {

RowSpool::RowSpool(size_t row_bytes, const std::string& temp_dir)
    : row_bytes_(row_bytes),
      rows_per_block_(std::max<size_t>(kBlockBytes / row_bytes, 1)),
      file_(temp_dir) {}

void RowSpool::append(const void* rows, size_t count) {
  const auto* bytes = static_cast<const unsigned char*>(rows);
  pending_.insert(pending_.end(), bytes, bytes + count * row_bytes_);
  if (pending_.size() < kBlocks * kBlockBytes) return;
  file_.append(pending_.data(), pending_.size());
  pending_.clear();
}

void RowSpool::finish() {
  if (!pending_.empty()) file_.append(pending_.data(), pending_.size());
  pending_ = {};
  cache_.resize(kBlocks * rows_per_block_ * row_bytes_);
  held_.assign(kBlocks, 0);
}

const void* RowSpool::row(uint64_t index) {
  const uint64_t block = index / rows_per_block_;
  const size_t place = static_cast<size_t>(block % kBlocks);
  const size_t block_bytes = rows_per_block_ * row_bytes_;
  unsigned char* at = cache_.data() + place * block_bytes;
  if (held_[place] != block + 1) {
    const uint64_t offset = block * block_bytes;
    file_.readAt(offset, at,
                 static_cast<size_t>(std::min<uint64_t>(block_bytes, file_.size() - offset)));
    held_[place] = block + 1;
  }
  return at + static_cast<size_t>(index % rows_per_block_) * row_bytes_;
}

}  // namespace tetstream
