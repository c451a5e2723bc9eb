#include "vtu_spool.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

constexpr int kLevel = 1;             // higher levels gain little on numbers and cost much
constexpr uint64_t kHeaderWords = 3;  // of a block table: count, block size, size of the last
constexpr uint64_t kWordBytes = 8;    // header_type UInt64

BlockCompressor::BlockCompressor() {
  // note: first, because zlib's state would be lost if this threw after it.
  out_.reserve(compressBound(kVtuBlockBytes));
  if (deflateInit(&stream_, kLevel) != Z_OK) fail(Status::kNoMemory, "no memory for zlib");
}

BlockCompressor::~BlockCompressor() {
  deflateEnd(&stream_);
}

const std::vector<unsigned char>& BlockCompressor::compress(const void* data, size_t size) {
  deflateReset(&stream_);
  out_.resize(deflateBound(&stream_, static_cast<uLong>(size)));
  stream_.next_in = static_cast<Bytef*>(const_cast<void*>(data));
  stream_.avail_in = static_cast<uInt>(size);
  stream_.next_out = out_.data();
  stream_.avail_out = static_cast<uInt>(out_.size());
  if (deflate(&stream_, Z_FINISH) != Z_STREAM_END)
    fail(Status::kInternal, "zlib needs more room than it said");
  out_.resize(out_.size() - stream_.avail_out);
  return out_;
}

VtuSpool::VtuSpool(const std::string& temp_dir, BlockCompressor* compressor)
    : compressor_(compressor), file_(temp_dir) {
  if (compressor_) block_.reserve(kVtuBlockBytes);
}

void VtuSpool::append(const void* data, size_t size) {
  const unsigned char* from = static_cast<const unsigned char*>(data);
  plain_bytes_ += size;
  if (!compressor_) return file_.append(data, size);
  while (size > 0) {
    const size_t n = std::min(size, kVtuBlockBytes - block_.size());
    block_.insert(block_.end(), from, from + n);
    if (block_.size() == kVtuBlockBytes) endBlock();
    from += n;
    size -= n;
  }
}

void VtuSpool::endBlock() {
  const std::vector<unsigned char>& packed = compressor_->compress(block_.data(), block_.size());
  const uint32_t size = static_cast<uint32_t>(packed.size());
  file_.append(&size, sizeof size);
  file_.append(packed.data(), packed.size());
  compressed_bytes_ += size;
  ++block_count_;
  block_.clear();
}

void VtuSpool::close() {
  if (!block_.empty()) endBlock();
  block_ = {};
  file_.close();
}

uint64_t VtuSpool::encodedBytes() const {
  if (!compressor_) return kWordBytes + plain_bytes_;
  return (kHeaderWords + block_count_) * kWordBytes + compressed_bytes_;
}

void VtuSpool::write(BufferedSink& sink) {
  if (!compressor_) {
    writeWord(sink, plain_bytes_);
    return file_.write(sink);
  }
  writeWord(sink, block_count_);
  writeWord(sink, kVtuBlockBytes);
  writeWord(sink, plain_bytes_ % kVtuBlockBytes);
  uint32_t size;
  uint64_t at = 0;
  for (uint64_t i = 0; i < block_count_; ++i, at += sizeof size + size) {
    file_.readAt(at, &size, sizeof size);
    writeWord(sink, size);
  }
  at = 0;
  for (uint64_t i = 0; i < block_count_; ++i, at += size) {
    file_.readAt(at, &size, sizeof size);
    at += sizeof size;
    file_.write(sink, at, size);
  }
}

}  // namespace tetstream
