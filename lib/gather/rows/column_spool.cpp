#include "column_spool.h"

#include <algorithm>
#include <cstring>

namespace tetstream {

constexpr size_t kHeldBytes = 1 << 16;  // of every array of a mesh
constexpr size_t kCopyBytes = 1 << 14;  // on the stack

ColumnSpool::ColumnSpool(const std::string& temp_dir) : file_(temp_dir) {
  held_.reserve(kHeldBytes);
}

void ColumnSpool::append(const void* data, size_t size) {
  const unsigned char* from = static_cast<const unsigned char*>(data);
  size_ += size;
  if (held_.size() + size > kHeldBytes) {
    file_.append(held_.data(), held_.size());
    held_.clear();
  }
  if (size > kHeldBytes)
    file_.append(from, size);
  else
    held_.insert(held_.end(), from, from + size);
}

void ColumnSpool::appendSwapped(const void* data, size_t size, size_t count) {
  unsigned char swapped[kCopyBytes];
  const unsigned char* from = static_cast<const unsigned char*>(data);
  while (count > 0) {
    const size_t n = std::min(count, kCopyBytes / size);
    std::memcpy(swapped, from, n * size);
    swapBytes(swapped, size, n);
    append(swapped, n * size);
    from += n * size;
    count -= n;
  }
}

void ColumnSpool::close() {
  if (!held_.empty()) file_.append(held_.data(), held_.size());
  held_ = {};
}

void ColumnSpool::write(BufferedSink& sink, uint64_t begin, uint64_t size) {
  unsigned char bytes[kCopyBytes];
  while (size > 0) {
    const size_t n = static_cast<size_t>(std::min<uint64_t>(size, sizeof bytes));
    file_.readAt(begin, bytes, n);
    sink.write(bytes, n);
    begin += n;
    size -= n;
  }
}

}  // namespace tetstream
