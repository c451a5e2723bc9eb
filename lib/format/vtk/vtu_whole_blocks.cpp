#include "vtu_whole_blocks.h"

#include <algorithm>
#include <cstring>

#include "status.h"

namespace tetstream {

namespace {

class WholeBlocks final : public ValueBytes {
 public:
  WholeBlocks(BlockTable table, uint64_t size, std::unique_ptr<WholeDecoder> decoder,
              std::function<std::unique_ptr<ValueBytes>()> otherwise)
      : table_(std::move(table)),
        blocks_(table_.blocks()),
        size_(size),
        decoder_(std::move(decoder)),
        otherwise_(std::move(otherwise)) {}

  void readAt(uint64_t offset, void* out, size_t size) override {
    auto* to = static_cast<unsigned char*>(out);
    while (size > 0) {
      const uint64_t block = offset / table_.blockBytes();
      const uint64_t begin = block * table_.blockBytes();
      const auto within = static_cast<size_t>(offset - begin);
      const auto whole = static_cast<size_t>(std::min(table_.blockBytes(), size_ - begin));
      const size_t n = std::min(size, whole - within);
      readFrom(block, within, whole, to, n);
      to += n;
      offset += n;
      size -= n;
    }
  }

 private:
  // One that is wanted whole goes where it is wanted.
  void readFrom(uint64_t block, size_t within, size_t whole, unsigned char* out, size_t size) {
    if (block != block_ && block != refused_) {
      const bool is_direct = size == whole;
      if (!is_direct) {
        block_ = UINT64_MAX;  // until it is there
        plain_.resize(whole);
      }
      if (!decode(block, is_direct ? out : plain_.data(), whole))
        refused_ = block;
      else if (is_direct)
        return;
      else
        block_ = block;
    }
    if (block == block_)
      std::memcpy(out, plain_.data() + within, size);
    else
      readOtherwise(block, within, out, size);
  }

  bool decode(uint64_t block, unsigned char* out, size_t size) {
    uint64_t begin, compressed;
    table_.locate(block, &begin, &compressed);
    if (compressed > decoder_->mostFor(size)) return false;
    packed_.resize(static_cast<size_t>(compressed));
    blocks_.readAt(begin, packed_.data(), packed_.size());
    return decoder_->decode(packed_.data(), packed_.size(), out, size);
  }

  void readOtherwise(uint64_t block, size_t within, unsigned char* out, size_t size) {
    const uint64_t begin = block * table_.blockBytes();
    if (!otherwise_)
      fail(Status::kBadData, "%s: compressed block %llu (byte %llu of the values): it is damaged",
           blocks_.what().c_str(), static_cast<unsigned long long>(block),
           static_cast<unsigned long long>(begin));
    if (!other_) other_ = otherwise_();
    other_->readAt(begin + within, out, size);
  }

  BlockTable table_;
  EncodedRun blocks_;
  uint64_t size_;
  uint64_t block_ = UINT64_MAX, refused_ = UINT64_MAX;  // held in plain_; by the decoder
  std::unique_ptr<WholeDecoder> decoder_;
  std::function<std::unique_ptr<ValueBytes>()> otherwise_;
  std::unique_ptr<ValueBytes> other_;
  std::vector<unsigned char> packed_, plain_;
};

}  // namespace

std::unique_ptr<ValueBytes> openWholeBlocks(
    BlockTable table, uint64_t size, std::unique_ptr<WholeDecoder> decoder,
    std::function<std::unique_ptr<ValueBytes>()> otherwise) {
  return std::make_unique<WholeBlocks>(std::move(table), size, std::move(decoder),
                                       std::move(otherwise));
}

}  // namespace tetstream
