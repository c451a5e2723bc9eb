// file: numbers of a file that may be text or binary. Depends on file_scan.h, file_window.h.
#pragma once

#include <optional>

#include "file_scan.h"
#include "file_window.h"

namespace tetstream {

class NumberScan {
 public:
  explicit NumberScan(FileScan& file) : file_(file) {}
  void setBinary(bool swapped) {
    binary_ = true;
    swapped_ = swapped;
  }
  bool binary() const { return binary_; }

  // `count` numbers, each of `width` bytes, 4 or 8, if they are binary.
  void integers(int64_t* out, size_t count, size_t width, const char* what) {
    if (binary_)
      binaryIntegers(out, count, width, what);
    else
      file_.integers(out, count, what);
  }
  void reals(double* out, size_t count, size_t width, const char* what) {
    if (binary_)
      binaryReals(out, count, width, what);
    else
      file_.reals(out, count, what);
  }
  // Where they lie, until the next call, or else in `room`.
  const int64_t* integersHere(int64_t* room, size_t count, size_t width, const char* what) {
    if (!binary_) return file_.integersHere(room, count, what);
    binaryIntegers(room, count, width, what);
    return room;
  }
  int64_t integer(size_t width, const char* what) {
    int64_t value;
    integers(&value, 1, width, what);
    return value;
  }
  // As FileScan's: of text, several threads may read the rows.
  void expectRows(uint64_t rows, const RowPattern& pattern) {
    if (!binary_) file_.expectRows(rows, pattern);
  }
  // The number of things to come, at least `least_bytes` each; checked against the file's size.
  uint64_t count(size_t width, size_t least_bytes, const char* what);
  // Where the next rows lie, if they are binary, in a file that can seek, all of them. They stay
  // the next ones.
  std::optional<RowsPlace> rowsHere(uint64_t rows, size_t row_bytes) const;
  void pass(const RowsPlace& rows, const char* what) { file_.skipTo(rows.end(), what); }

 private:
  void binaryIntegers(int64_t* out, size_t count, size_t width, const char* what);
  void binaryReals(double* out, size_t count, size_t width, const char* what);

  FileScan& file_;
  bool binary_ = false, swapped_ = false;
};

}  // namespace tetstream
