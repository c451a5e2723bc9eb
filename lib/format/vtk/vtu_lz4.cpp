// Blocks of .vtu files that are blocks of LZ4, which are decompressed whole.
#ifdef TETSTREAM_WITH_LZ4
#include <lz4.h>

#include <algorithm>
#include <cstring>

#include "status.h"
#include "vtu_blocks.h"

namespace tetstream {

namespace {

constexpr uint64_t kMaxLz4Ratio = 256;             // 255 bytes for one at best
constexpr uint64_t kMaxBlock = uint64_t{1} << 26;  // VTK's are of 32 KiB

class Lz4Blocks final : public ValueBytes {
 public:
  Lz4Blocks(const EncodedRun& run, const VtuFile& file, uint64_t size)
      : table_(run, file, size, kMaxLz4Ratio), blocks_(table_.blocks()), size_(size) {
    if (std::min(table_.blockBytes(), size) > kMaxBlock)
      fail(Status::kUnsupported, "%s: LZ4 blocks of %llu bytes are not read, only up to 64 MiB",
           run.what().c_str(), static_cast<unsigned long long>(table_.blockBytes()));
  }

  void readAt(uint64_t offset, void* out, size_t size) override {
    unsigned char* to = static_cast<unsigned char*>(out);
    while (size > 0) {
      const uint64_t block = offset / table_.blockBytes();
      const size_t within = static_cast<size_t>(offset - block * table_.blockBytes());
      if (block != block_) load(block);
      const size_t n = std::min(size, plain_.size() - within);
      std::memcpy(to, plain_.data() + within, n);
      to += n;
      offset += n;
      size -= n;
    }
  }

 private:
  void load(uint64_t block) {
    block_ = UINT64_MAX;  // until it is there
    uint64_t begin, compressed;
    table_.locate(block, &begin, &compressed);
    // No good block is longer than this, whatever the table says.
    const int most = LZ4_compressBound(static_cast<int>(std::min(table_.blockBytes(), size_)));
    if (compressed > static_cast<uint64_t>(most)) failBlock(block);
    packed_.resize(static_cast<size_t>(compressed));
    blocks_.readAt(begin, packed_.data(), packed_.size());
    plain_.resize(
        static_cast<size_t>(std::min(table_.blockBytes(), size_ - block * table_.blockBytes())));
    const int made =
        LZ4_decompress_safe(packed_.data(), plain_.data(), static_cast<int>(packed_.size()),
                            static_cast<int>(plain_.size()));
    if (made != static_cast<int>(plain_.size())) failBlock(block);
    block_ = block;
  }

  [[noreturn]] void failBlock(uint64_t block) const {
    fail(Status::kBadData, "%s: compressed block %llu (byte %llu of the values): it is damaged",
         blocks_.what().c_str(), static_cast<unsigned long long>(block),
         static_cast<unsigned long long>(block * table_.blockBytes()));
  }

  BlockTable table_;
  EncodedRun blocks_;
  uint64_t size_, block_ = UINT64_MAX;
  std::vector<char> packed_, plain_;
};

}  // namespace

std::unique_ptr<ValueBytes> openLz4Blocks(const EncodedRun& run, const VtuFile& file,
                                          uint64_t size) {
  return std::make_unique<Lz4Blocks>(run, file, size);
}

}  // namespace tetstream
#endif
