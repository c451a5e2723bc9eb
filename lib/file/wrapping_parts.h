// file: what the wrappings of a file have in common. Depends on bytes.h.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "bytes.h"
#include "status.h"

namespace tetstream {

class WrappedSource : public ByteSource {
 public:
  size_t readAt(uint64_t, void*, size_t) override { return 0; }
  bool seekable() const override { return false; }
  uint64_t size() const override { return 0; }
  std::shared_ptr<Waiting> waiting() const override { return bytes_->waiting(); }

 protected:
  WrappedSource(std::unique_ptr<ByteSource> bytes, size_t buffer_bytes)
      : ByteSource(bytes->name()), bytes_(std::move(bytes)), buffer_(buffer_bytes) {}

  bool fill() {         // once all of it is taken; false at the end
    at_ = filled_ = 0;  // also if that fails
    filled_ = bytes_->read(buffer_.data(), buffer_.size());
    return filled_ > 0;
  }
  bool hasInput() const { return at_ < filled_; }
  const unsigned char* input() const { return buffer_.data() + at_; }
  size_t inputSize() const { return filled_ - at_; }
  void take(size_t size) { at_ += size; }
  [[noreturn]] void failWrapped(const char* text) const {
    fail(Status::kBadData, "%s: %s", name().c_str(), text);
  }

 private:
  std::unique_ptr<ByteSource> bytes_;
  std::vector<unsigned char> buffer_;
  size_t at_ = 0, filled_ = 0;
};

class WrappedSink : public ByteSink {
 public:
  void writeAt(uint64_t, const void*, size_t) override {
    fail(Status::kInternal, "%s: what is compressed cannot be changed", name().c_str());
  }
  bool seekable() const override { return false; }
  bool waits() const override { return bytes_->waits(); }
  void commit() override {
    end();
    bytes_->commit();
  }

 protected:
  explicit WrappedSink(std::unique_ptr<ByteSink> bytes)
      : ByteSink(bytes->name()), bytes_(std::move(bytes)) {}
  virtual void end() = 0;  // writes what is still held
  ByteSink& inner() { return *bytes_; }

 private:
  std::unique_ptr<ByteSink> bytes_;
};

// gzip_bytes.cpp, zstd_bytes.cpp
std::unique_ptr<ByteSource> openGzip(std::unique_ptr<ByteSource> bytes);
std::unique_ptr<ByteSource> openZstd(std::unique_ptr<ByteSource> bytes);
std::unique_ptr<ByteSink> createGzip(std::unique_ptr<ByteSink> bytes);
std::unique_ptr<ByteSink> createZstd(std::unique_ptr<ByteSink> bytes);

}  // namespace tetstream
