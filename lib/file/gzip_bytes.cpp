// gzip's wrapping (RFC 1952), one member or several.
#include <zlib.h>

#include <algorithm>
#include <vector>

#include "status.h"
#include "wrapping_parts.h"

namespace tetstream {

namespace {

constexpr size_t kPackedBytes = 1 << 16;
constexpr int kGzipWindow = 15 + 16;  // zlib's word for the largest window and gzip's head
constexpr int kGzipLevel = 6;

class GzipSource final : public WrappedSource {
 public:
  explicit GzipSource(std::unique_ptr<ByteSource> bytes)
      : WrappedSource(std::move(bytes), kPackedBytes) {
    if (inflateInit2(&stream_, kGzipWindow) != Z_OK) fail(Status::kNoMemory, "no memory for zlib");
  }
  ~GzipSource() override { inflateEnd(&stream_); }

  size_t read(void* out, size_t size) override {
    stream_.next_out = static_cast<Bytef*>(out);
    const auto most = static_cast<uInt>(std::min<size_t>(size, 1 << 30));
    stream_.avail_out = most;
    while (stream_.avail_out == most && most > 0) {
      if (!hasInput() && !fill()) {
        if (within_) failWrapped("the file ends within its compressed data");
        return 0;
      }
      if (!within_ && !begin()) return 0;
      step();
    }
    return most - stream_.avail_out;
  }

 private:
  // A further member; zeros after the last one are padding.
  bool begin() {
    if (any_ && *input() == 0) {
      do {
        while (hasInput())
          if (*input() == 0)
            take(1);
          else
            failWrapped("bytes that mean nothing follow the compressed data");
      } while (fill());
      return false;
    }
    within_ = any_ = true;
    inflateReset(&stream_);
    return true;
  }

  void step() {
    stream_.next_in = const_cast<Bytef*>(input());
    stream_.avail_in = static_cast<uInt>(inputSize());
    const int result = inflate(&stream_, Z_NO_FLUSH);
    take(inputSize() - stream_.avail_in);
    if (result == Z_STREAM_END) {
      within_ = false;
    } else if (result == Z_MEM_ERROR) {
      fail(Status::kNoMemory, "no memory for zlib");
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      failWrapped("the compressed data are damaged");
    }
  }

  z_stream stream_{};
  bool within_ = false, any_ = false;  // a member
};

class GzipSink final : public WrappedSink {
 public:
  explicit GzipSink(std::unique_ptr<ByteSink> bytes) : WrappedSink(std::move(bytes)) {
    buffer_.resize(kPackedBytes);
    if (deflateInit2(&stream_, kGzipLevel, Z_DEFLATED, kGzipWindow, 8, Z_DEFAULT_STRATEGY) != Z_OK)
      fail(Status::kNoMemory, "no memory for zlib");
  }
  ~GzipSink() override { deflateEnd(&stream_); }

  void write(const void* data, size_t size) override {
    const auto* at = static_cast<const Bytef*>(data);
    while (size > 0) {
      const size_t part = std::min<size_t>(size, 1 << 30);
      pass(at, part, Z_NO_FLUSH);
      at += part;
      size -= part;
    }
  }

 private:
  void end() override { pass(nullptr, 0, Z_FINISH); }

  void pass(const Bytef* data, size_t size, int flush) {
    stream_.next_in = const_cast<Bytef*>(data);
    stream_.avail_in = static_cast<uInt>(size);
    do {
      stream_.next_out = buffer_.data();
      stream_.avail_out = static_cast<uInt>(buffer_.size());
      deflate(&stream_, flush);
      inner().write(buffer_.data(), buffer_.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

  z_stream stream_{};
  std::vector<unsigned char> buffer_;
};

}  // namespace

std::unique_ptr<ByteSource> openGzip(std::unique_ptr<ByteSource> bytes) {
  return std::make_unique<GzipSource>(std::move(bytes));
}

std::unique_ptr<ByteSink> createGzip(std::unique_ptr<ByteSink> bytes) {
  return std::make_unique<GzipSink>(std::move(bytes));
}

}  // namespace tetstream
