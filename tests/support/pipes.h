// tests: bytes that come and go as through a pipe: a few at a time, and not to be sought.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bytes.h"

namespace tetstream::test {

using Bytes = std::vector<unsigned char>;

class PipeSource final : public ByteSource {
 public:
  // Gives up to `step` bytes at a time; 0: odd numbers, each time another.
  PipeSource(const Bytes& data, size_t step, const std::string& name = "pipe")
      : ByteSource(name), data_(data), step_(step) {}
  size_t read(void* out, size_t size) override {
    turn_ = turn_ % 97 + 1;
    const size_t got = std::min({size, step_ ? step_ : 7 * turn_, data_.size() - place_});
    std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(place_), got,
                static_cast<unsigned char*>(out));
    place_ += got;
    return got;
  }
  size_t readAt(uint64_t, void*, size_t) override {
    ADD_FAILURE() << "a pipe was asked to seek";
    return 0;
  }
  bool seekable() const override { return false; }
  uint64_t size() const override {
    ADD_FAILURE() << "a pipe was asked for its size";
    return 0;
  }

 private:
  const Bytes& data_;
  size_t step_, place_ = 0, turn_ = 0;
};

class PipeSink final : public ByteSink {
 public:
  // Counts in `commits` how often it is committed, if that is given.
  explicit PipeSink(Bytes& out, int* commits = nullptr)
      : ByteSink("pipe"), out_(out), commits_(commits) {
    out_.clear();
  }
  void write(const void* data, size_t size) override {
    const unsigned char* bytes = static_cast<const unsigned char*>(data);
    out_.insert(out_.end(), bytes, bytes + size);
  }
  void writeAt(uint64_t, const void*, size_t) override { ADD_FAILURE() << "a pipe cannot seek"; }
  bool seekable() const override { return false; }
  void commit() override {
    if (commits_) ++*commits_;
  }

 private:
  Bytes& out_;
  int* commits_;
};

}  // namespace tetstream::test
