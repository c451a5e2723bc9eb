// Blocks of .vtu files that are blocks of LZ4.
#ifdef TETSTREAM_WITH_LZ4
#include <lz4.h>

#include <algorithm>

#include "status.h"
#include "vtu_whole_blocks.h"

namespace tetstream {

namespace {

constexpr uint64_t kMaxLz4Ratio = 256;             // 255 bytes for one at best
constexpr uint64_t kMaxBlock = uint64_t{1} << 26;  // VTK's are of 32 KiB

class Lz4Decoder final : public WholeDecoder {
 public:
  size_t mostFor(size_t size) const override {
    return static_cast<size_t>(LZ4_compressBound(static_cast<int>(size)));
  }
  bool decode(const unsigned char* packed, size_t packed_size, unsigned char* out,
              size_t size) override {
    const int made =
        LZ4_decompress_safe(reinterpret_cast<const char*>(packed), reinterpret_cast<char*>(out),
                            static_cast<int>(packed_size), static_cast<int>(size));
    return made == static_cast<int>(size);
  }
};

}  // namespace

std::unique_ptr<ValueBytes> openLz4Blocks(const EncodedRun& run, const VtuFile& file,
                                          uint64_t size) {
  BlockTable table(run, file, size, kMaxLz4Ratio);
  if (std::min(table.blockBytes(), size) > kMaxBlock)
    fail(Status::kUnsupported, "%s: LZ4 blocks of %llu bytes are not read, only up to 64 MiB",
         run.what().c_str(), static_cast<unsigned long long>(table.blockBytes()));
  return openWholeBlocks(std::move(table), size, std::make_unique<Lz4Decoder>());
}

}  // namespace tetstream
#endif
