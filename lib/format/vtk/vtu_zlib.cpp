// Blocks of .vtu files that are zlib streams.
#include <zlib.h>

#include "vtu_blocks.h"

namespace tetstream {

namespace {

// Deflate makes at most 1032 bytes of one.
constexpr uint64_t kMaxZlibRatio = 1040;

class ZlibDecoder final : public BlockDecoder {
 public:
  ~ZlibDecoder() override {
    if (open_) inflateEnd(&stream_);
  }

  Result start() override {
    if (open_) return inflateReset(&stream_) == Z_OK ? Result::kMore : Result::kDamaged;
    open_ = inflateInit(&stream_) == Z_OK;
    return open_ ? Result::kMore : Result::kNoMemory;
  }

  Result step(Buffers& buffers) override {
    stream_.next_in = const_cast<Bytef*>(buffers.in);
    stream_.avail_in = static_cast<uInt>(buffers.in_size);
    stream_.next_out = buffers.out;
    stream_.avail_out = static_cast<uInt>(buffers.out_size);
    const int result = inflate(&stream_, Z_NO_FLUSH);
    buffers = {stream_.next_in, stream_.avail_in, stream_.next_out, stream_.avail_out};
    if (result == Z_MEM_ERROR) return Result::kNoMemory;
    if (result == Z_STREAM_END) return Result::kEnd;
    return result == Z_OK || result == Z_BUF_ERROR ? Result::kMore : Result::kDamaged;
  }

  const char* problem() const override { return stream_.msg ? stream_.msg : "it is damaged"; }

 private:
  z_stream stream_{};
  bool open_ = false;
};

}  // namespace

std::unique_ptr<ValueBytes> openZlibBlocks(const EncodedRun& run, const VtuFile& file,
                                           uint64_t size) {
  return openStreamedBlocks(BlockTable(run, file, size, kMaxZlibRatio), run, size,
                            std::make_unique<ZlibDecoder>());
}

}  // namespace tetstream
