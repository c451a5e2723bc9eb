// swig: arrays that cross between a language and the library. The language's typemaps know these
// two classes; everything else is written with them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

namespace tetstream::swig {

// TETSTREAM_TYPE_... for numbers, and one more for flags.
constexpr int32_t kBytes = 5;

// Bytes of one number; 0 for no type.
size_t sizeOfType(int32_t type);

// Somebody else's dense array [rows][columns]; data is null for no array.
struct ArrayView {
  const void* data = nullptr;
  int32_t type = 0;
  int64_t rows = 0;
  int32_t columns = 1;
};

// An array [rows][columns] that grows at its end and is handed over to the language, which frees
// it. note: realloc moves large blocks by their pages, so growing takes no second copy of the mesh,
// and pages that were never written take no memory.
class OwnedArray {
 public:
  OwnedArray() = default;
  OwnedArray(int32_t type, int32_t columns) : type_(type), columns_(columns) {}

  // Throws std::bad_alloc.
  void append(const void* rows, int64_t count);
  // The same rows, all zero bytes.
  void appendZeros(int64_t count);
  // int64 rows narrowed into an int32 array: the values are known to fit.
  void appendNarrowed(const int64_t* rows, int64_t count);

  int32_t type() const { return type_; }
  int64_t rows() const { return rows_; }
  int32_t columns() const { return columns_; }
  void* data() const { return data_.get(); }
  // What free() is to free, cut to what is used; nothing is left here.
  void* release();

 private:
  struct Free {
    void operator()(void* data) const { std::free(data); }
  };
  size_t rowBytes() const { return sizeOfType(type_) * static_cast<size_t>(columns_); }
  void* more(int64_t count);  // place for that many more rows, which count from now on
  void resize(size_t bytes);

  std::unique_ptr<void, Free> data_;
  int32_t type_ = 0, columns_ = 1;
  int64_t rows_ = 0;
  size_t capacity_ = 0;  // bytes
};

}  // namespace tetstream::swig
