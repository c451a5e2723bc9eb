// format/sv: the bytes of a streaming mesh file, looked at before they are taken. Depends on
// bytes.h.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bytes.h"

namespace tetstream {

class SvBytes {
 public:
  explicit SvBytes(std::unique_ptr<ByteSource> source);

  // What is buffered and not yet taken; moved by more().
  const unsigned char* data() const { return buffer_.data() + begin_; }
  size_t size() const { return buffer_.size() - begin_; }
  uint64_t offset() const { return offset_; }  // of data() in the file
  const std::string& name() const { return source_->name(); }

  bool more();               // reads on behind what is buffered; false at the end of the file
  bool want(size_t count);   // reads until `count` bytes are buffered; false: the file is too short
  void drop(size_t count) {  // takes the first bytes
    begin_ += count;
    offset_ += count;
  }

  bool seekable() const { return source_->seekable(); }
  // Spools what was not yet taken of a pipe, so that readAt works.
  void makeSeekable(const std::string& temp_dir);
  // Reads at a place of the file; nothing moves. Short only at the end.
  size_t readAt(uint64_t offset, void* out, size_t size) {
    return source_->readAt(offset - origin_, out, size);
  }

 private:
  std::unique_ptr<ByteSource> source_;
  uint64_t origin_ = 0;  // place in the file of the source's first byte
  uint64_t offset_ = 0;
  size_t begin_ = 0;
  std::vector<unsigned char> buffer_;
};

}  // namespace tetstream
