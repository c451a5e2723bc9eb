#include "row_spool.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "check_sum.h"
#include "status.h"

namespace tetstream {

RowSpool::RowSpool(size_t row_bytes, const std::string& temp_dir, SpoolShape shape)
    : row_bytes_(row_bytes),
      blocks_(shape.blocks),
      shift_(static_cast<unsigned>(
          std::bit_width(std::max<size_t>(shape.block_bytes / row_bytes, 1)) - 1)),
      temp_dir_(temp_dir) {}

size_t RowSpool::bytesOf(uint64_t block) const {
  const uint64_t in_block = std::min(rows_ - (block << shift_), uint64_t{1} << shift_);
  return static_cast<size_t>(in_block) * row_bytes_;
}

// Whole blocks, at the end the last one, too.
void RowSpool::writeBlocks(bool all) {
  if (!file_) file_.emplace(temp_dir_);
  size_t done = 0;
  while (held_.size() - done >= (all ? 1 : blockBytes())) {
    const size_t bytes = std::min(held_.size() - done, blockBytes());
    const uint64_t sum = checkSum(held_.data() + done, bytes);
    file_->append(held_.data() + done, bytes);
    file_->append(&sum, sizeof sum);
    done += bytes;
    ++written_;
  }
  held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(done));
}

void RowSpool::append(const void* rows, size_t count) {
  const auto* bytes = static_cast<const unsigned char*>(rows);
  rows_ += count;
  for (size_t left = count; left > 0;) {  // never more than a block above what may be held
    const size_t some = std::min(left, size_t{1} << shift_);
    held_.insert(held_.end(), bytes, bytes + some * row_bytes_);
    bytes += some * row_bytes_;
    left -= some;
    if (held_.size() > blocks_ * blockBytes()) writeBlocks(false);
  }
}

void RowSpool::finish() {
  if (!file_) return;
  writeBlocks(true);
  held_ = {};  // until it is read
  block_at_.assign(blocks_, 0);
}

void RowSpool::readBlock(uint64_t block, size_t place) {
  if (held_.empty()) held_.resize(blocks_ * blockBytes());
  unsigned char* at = held_.data() + place * blockBytes();
  const uint64_t offset = block * (blockBytes() + sizeof(uint64_t));
  const size_t bytes = bytesOf(block);
  uint64_t sum;
  block_at_[place] = 0;
  file_->readAt(offset, at, bytes);
  file_->readAt(offset + bytes, &sum, sizeof sum);
  if (sum != checkSum(at, bytes))
    fail(Status::kIo, "block %llu of a temporary file was damaged since it was written",
         static_cast<unsigned long long>(block));
  block_at_[place] = block + 1;
}

const void* RowSpool::row(uint64_t index) {
  if (!file_) return held_.data() + static_cast<size_t>(index) * row_bytes_;
  const uint64_t block = index >> shift_;
  const auto place = static_cast<size_t>(block % blocks_);
  if (block_at_[place] != block + 1) readBlock(block, place);
  const uint64_t in_block = index & ((uint64_t{1} << shift_) - 1);
  return held_.data() + place * blockBytes() + static_cast<size_t>(in_block) * row_bytes_;
}

}  // namespace tetstream
