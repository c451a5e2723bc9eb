#include "arrays.h"

#include <tetstream/tetstream.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace tetstream::swig {

size_t sizeOfType(int32_t type) {
  switch (type) {
    case TETSTREAM_TYPE_FLOAT32:
    case TETSTREAM_TYPE_INT32:
      return 4;
    case TETSTREAM_TYPE_FLOAT64:
    case TETSTREAM_TYPE_INT64:
      return 8;
    case kBytes:
      return 1;
    default:
      return 0;
  }
}

void OwnedArray::resize(size_t bytes) {
  void* const moved = std::realloc(data_.get(), std::max<size_t>(bytes, 1));
  if (!moved) throw std::bad_alloc();
  (void)data_.release();  // realloc has freed or kept it
  data_.reset(moved);
  capacity_ = bytes;
}

void* OwnedArray::more(int64_t count) {
  const size_t used = static_cast<size_t>(rows_) * rowBytes();
  const size_t needed = used + static_cast<size_t>(count) * rowBytes();
  if (needed > capacity_) resize(std::max(needed, capacity_ + capacity_ / 2));
  rows_ += count;
  return static_cast<char*>(data_.get()) + used;
}

void OwnedArray::append(const void* rows, int64_t count) {
  if (count > 0) std::memcpy(more(count), rows, static_cast<size_t>(count) * rowBytes());
}

void OwnedArray::appendZeros(int64_t count) {
  if (count > 0) std::memset(more(count), 0, static_cast<size_t>(count) * rowBytes());
}

void OwnedArray::appendNarrowed(const int64_t* rows, int64_t count) {
  if (count <= 0) return;
  auto* const out = static_cast<int32_t*>(more(count));
  std::transform(rows, rows + count * columns_, out,
                 [](int64_t value) { return static_cast<int32_t>(value); });
}

void* OwnedArray::release() {
  resize(static_cast<size_t>(rows_) * rowBytes());
  capacity_ = 0;
  rows_ = 0;
  return data_.release();
}

}  // namespace tetstream::swig
