// gather/rows: the bytes of one array on their way out, kept in a temporary file until what stands
// before them in the output is known. Depends on bytes.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bytes.h"
#include "values.h"

namespace tetstream {

class ColumnSpool {
 public:
  explicit ColumnSpool(const std::string& temp_dir);

  void append(const void* data, size_t size);
  // As above, `count` values of `size` bytes each, of which the bytes are turned around.
  void appendSwapped(const void* data, size_t size, size_t count);
  void close();  // after the last append
  uint64_t size() const { return size_; }
  void readAt(uint64_t begin, void* out, size_t size) { file_.readAt(begin, out, size); }
  // Bytes [begin, begin + size), or all of them.
  void write(BufferedSink& sink, uint64_t begin, uint64_t size);
  void write(BufferedSink& sink) { write(sink, 0, size_); }

 private:
  SpoolFile file_;
  std::vector<unsigned char> held_;
  uint64_t size_ = 0;
};

}  // namespace tetstream
