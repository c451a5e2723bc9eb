// gather/rows: rows that come in any order and are then read in sequence. Depends on bytes.h.
#pragma once

#include <string>
#include <vector>

#include "bytes.h"

namespace tetstream {

// Rows that never come are zero. Runs of rows that follow each other are written at once.
class ScatteredRows {
 public:
  ScatteredRows(size_t row_bytes, const std::string& temp_dir)
      : row_bytes_(row_bytes), file_(temp_dir) {}
  void put(uint64_t row, const void* values);
  void finish(uint64_t rows);  // how many there are
  void read(uint64_t first, size_t count, void* out) {
    file_.readAt(first * row_bytes_, out, count * row_bytes_);
  }
  uint64_t given() const { return given_; }  // rows, each once
  size_t rowBytes() const { return row_bytes_; }

 private:
  bool isNew(uint64_t row);
  void flush();

  size_t row_bytes_;
  SpoolFile file_;
  std::vector<unsigned char> run_;
  std::vector<bool> came_;  // the rows, once they do not come in sequence
  uint64_t run_first_ = 0, next_ = 0, given_ = 0;
};

}  // namespace tetstream
