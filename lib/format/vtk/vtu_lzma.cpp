// Blocks of .vtu files that are .xz streams.
#ifdef TETSTREAM_WITH_LZMA
#include <lzma.h>

#include "vtu_blocks.h"

namespace tetstream {

namespace {

// At best, some 273 bytes for a fifth of a bit.
constexpr uint64_t kMaxLzmaRatio = 1 << 14;
// The highest level of compression needs 65 MiB; a damaged header may ask for gigabytes.
constexpr uint64_t kMemoryLimit = uint64_t{80} << 20;

class LzmaDecoder final : public BlockDecoder {
 public:
  ~LzmaDecoder() override { lzma_end(&stream_); }

  Result start() override {
    return resultOf(lzma_stream_decoder(&stream_, kMemoryLimit, LZMA_TELL_UNSUPPORTED_CHECK));
  }

  Result step(Buffers& buffers) override {
    stream_.next_in = buffers.in;
    stream_.avail_in = buffers.in_size;
    stream_.next_out = buffers.out;
    stream_.avail_out = buffers.out_size;
    const Result result = resultOf(lzma_code(&stream_, LZMA_RUN));
    buffers = {stream_.next_in, stream_.avail_in, stream_.next_out, stream_.avail_out};
    return result;
  }

  const char* problem() const override { return problem_; }

 private:
  Result resultOf(lzma_ret code) {
    problem_ = "it is damaged";
    if (code == LZMA_MEMLIMIT_ERROR) problem_ = "it needs more than 80 MiB to be decompressed";
    if (code == LZMA_STREAM_END) return Result::kEnd;
    if (code == LZMA_MEM_ERROR) return Result::kNoMemory;
    return code == LZMA_OK || code == LZMA_BUF_ERROR ? Result::kMore : Result::kDamaged;
  }

  lzma_stream stream_ = LZMA_STREAM_INIT;
  const char* problem_ = "";
};

}  // namespace

std::unique_ptr<ValueBytes> openLzmaBlocks(const EncodedRun& run, const VtuFile& file,
                                           uint64_t size) {
  return openStreamedBlocks(BlockTable(run, file, size, kMaxLzmaRatio), run, size,
                            std::make_unique<LzmaDecoder>());
}

}  // namespace tetstream
#endif
