// Blocks of .vtu files that are zlib streams. libdeflate takes half of zlib's time and less, but
// only whole ones; what it refuses zlib reads, as far as it is sound, and says what is wrong.
#include <zlib.h>
#ifdef TETSTREAM_WITH_DEFLATE
#include <libdeflate.h>
#endif

#include <algorithm>

#include "status.h"
#include "vtu_whole_blocks.h"

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

std::unique_ptr<ValueBytes> openByZlib(BlockTable table, const EncodedRun& run, uint64_t size) {
  return openStreamedBlocks(std::move(table), run, size, std::make_unique<ZlibDecoder>());
}

#ifdef TETSTREAM_WITH_DEFLATE

// VTK's are of 32 KiB. Twice this is held for each array, and for each thread that reads it.
constexpr uint64_t kMostWhole = 1 << 18;

class DeflateDecoder final : public WholeDecoder {
 public:
  explicit DeflateDecoder(const EncodedRun& run) : decompressor_(libdeflate_alloc_decompressor()) {
    if (!decompressor_)
      fail(Status::kNoMemory, "%s: no memory to decompress it", run.what().c_str());
  }
  ~DeflateDecoder() override { libdeflate_free_decompressor(decompressor_); }
  DeflateDecoder(const DeflateDecoder&) = delete;
  DeflateDecoder& operator=(const DeflateDecoder&) = delete;

  size_t mostFor(size_t size) const override { return compressBound(size); }
  bool decode(const unsigned char* packed, size_t packed_size, unsigned char* out,
              size_t size) override {
    size_t used;  // what stands behind a block's end is passed over
    return libdeflate_zlib_decompress_ex(decompressor_, packed, packed_size, out, size, &used,
                                         nullptr) == LIBDEFLATE_SUCCESS;
  }

 private:
  libdeflate_decompressor* decompressor_;
};

#endif

}  // namespace

std::unique_ptr<ValueBytes> openZlibBlocks(const EncodedRun& run, const VtuFile& file,
                                           uint64_t size) {
  BlockTable table(run, file, size, kMaxZlibRatio);
#ifdef TETSTREAM_WITH_DEFLATE
  if (std::min(table.blockBytes(), size) <= kMostWhole)
    return openWholeBlocks(
        std::move(table), size, std::make_unique<DeflateDecoder>(run), [run, &file, size] {
          return openByZlib(BlockTable(run, file, size, kMaxZlibRatio), run, size);
        });
#endif
  return openByZlib(std::move(table), run, size);
}

}  // namespace tetstream
