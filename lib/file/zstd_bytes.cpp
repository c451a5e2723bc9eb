// zstd's wrapping (RFC 8878), one frame or several.
#include "status.h"
#include "wrapping_parts.h"
#include "zstd_result.h"

#ifdef TETSTREAM_WITH_ZSTD
#include <utility>
#include <vector>
#endif

namespace tetstream {

#ifdef TETSTREAM_WITH_ZSTD

namespace {

constexpr int kZstdLevel = 3;

void checkZstd(size_t result, const std::string& name) {
  if (!zstdFailed(result)) return;
  if (ZSTD_getErrorCode(result) == ZSTD_error_frameParameter_windowTooLarge)
    fail(Status::kUnsupported, "%s: zstd packed it with a window of more than 128 MiB",
         name.c_str());
  fail(Status::kBadData, "%s: the compressed data are damaged: %s", name.c_str(),
       ZSTD_getErrorName(result));
}

class ZstdSource final : public WrappedSource {
 public:
  explicit ZstdSource(std::unique_ptr<ByteSource> bytes)
      : WrappedSource(std::move(bytes), ZSTD_DStreamInSize()), stream_(ZSTD_createDStream()) {
    if (!stream_) fail(Status::kNoMemory, "no memory for zstd");
  }
  ~ZstdSource() override { ZSTD_freeDStream(stream_); }

  size_t read(void* out, size_t size) override {
    ZSTD_outBuffer to = {out, size, 0};
    while (to.pos == 0 && size > 0) {
      // note: what was decoded may still be within the stream when all input is taken.
      const bool more = hasInput() || fill();
      if (!more && !within_) return 0;
      ZSTD_inBuffer from = {input(), inputSize(), 0};
      const size_t hint = ZSTD_decompressStream(stream_, &to, &from);
      checkZstd(hint, name());
      take(from.pos);
      within_ = hint != 0;
      if (!more && to.pos == 0 && within_) failWrapped("the file ends within its compressed data");
    }
    return to.pos;
  }

 private:
  ZSTD_DStream* stream_;
  bool within_ = false;  // a frame
};

class ZstdSink final : public WrappedSink {
 public:
  explicit ZstdSink(std::unique_ptr<ByteSink> bytes)
      : WrappedSink(std::move(bytes)), stream_(ZSTD_createCStream()) {
    if (!stream_) fail(Status::kNoMemory, "no memory for zstd");
    buffer_.resize(ZSTD_CStreamOutSize());
    ZSTD_CCtx_setParameter(stream_, ZSTD_c_compressionLevel, kZstdLevel);
    ZSTD_CCtx_setParameter(stream_, ZSTD_c_checksumFlag, 1);
  }
  ~ZstdSink() override { ZSTD_freeCStream(stream_); }

  void write(const void* data, size_t size) override { pass(data, size, ZSTD_e_continue); }

 private:
  void end() override { pass(nullptr, 0, ZSTD_e_end); }

  void pass(const void* data, size_t size, ZSTD_EndDirective end) {
    ZSTD_inBuffer from = {data, size, 0};
    for (;;) {
      ZSTD_outBuffer to = {buffer_.data(), buffer_.size(), 0};
      const size_t left = ZSTD_compressStream2(stream_, &to, &from, end);
      if (zstdFailed(left)) fail(Status::kInternal, "zstd: %s", ZSTD_getErrorName(left));
      inner().write(buffer_.data(), to.pos);
      if (end == ZSTD_e_continue ? from.pos == from.size : left == 0) return;
    }
  }

  ZSTD_CStream* stream_;
  std::vector<unsigned char> buffer_;
};

}  // namespace

std::unique_ptr<ByteSource> openZstd(std::unique_ptr<ByteSource> bytes) {
  return std::make_unique<ZstdSource>(std::move(bytes));
}

std::unique_ptr<ByteSink> createZstd(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<ZstdSink>(std::move(bytes));
}

#else

std::unique_ptr<ByteSource> openZstd(std::unique_ptr<ByteSource> bytes) {
  fail(Status::kUnsupported, "%s: compressed with zstd, which this build does not have",
       bytes->name().c_str());
}

std::unique_ptr<ByteSink> createZstd(std::unique_ptr<ByteSink> bytes) {
  fail(Status::kUnsupported, "%s: this build does not have zstd", bytes->name().c_str());
}

#endif

}  // namespace tetstream
