// stream: the rows of one column of a mesh. Depends on row_spool.h.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "row_spool.h"

namespace tetstream {

// Rows that lie somewhere, as a file has them, in the layout of the column.
class RowReader {
 public:
  virtual ~RowReader() = default;
  virtual void read(uint64_t first, size_t count, void* out) = 0;
};

// The parts of a column that are read where they lie, among rows that are not.
class PlacedParts {
 public:
  // Each costs some memory and a look of its own: what comes then is to be copied.
  static constexpr size_t kMost = 1024;

  bool isFull() const { return parts_.size() == kMost; }
  // Rows [rank, rank + count) of the column, which come behind those of all parts before.
  void add(uint64_t rank, uint64_t count, std::shared_ptr<RowReader> reader);
  uint64_t rows() const { return rows_; }

  // Rows [first, first + count) of the column: those of parts from their readers; of the others
  // copied(index among those, how many, where to).
  template <class Copied>
  void read(uint64_t first, size_t count, size_t row_bytes, void* out, Copied copied) const {
    auto* to = static_cast<unsigned char*>(out);
    for (Run run; count > 0; first += run.rows, count -= run.rows, to += run.rows * row_bytes) {
      run = runFrom(first, count);
      if (run.reader)
        run.reader->read(run.index, run.rows, to);
      else
        copied(run.index, run.rows, to);
    }
  }

 private:
  struct Part {
    uint64_t rank, count, before;  // before: rows of the parts before it
    std::shared_ptr<RowReader> reader;
  };
  struct Run {
    RowReader* reader = nullptr;  // null: rows that are copied
    uint64_t index = 0;           // of its first row there
    size_t rows = 0;
  };
  Run runFrom(uint64_t first, size_t most) const;

  std::vector<Part> parts_;
  uint64_t rows_ = 0;
};

// Rows that come one after the other, and are copied to a temporary file if they are many, and rows
// that are read where they lie, in the order in which they were told.
class ColumnRows {
 public:
  ColumnRows(size_t row_bytes, const std::string& temp_dir, SpoolShape shape, const Tasks* tasks)
      : row_bytes_(row_bytes), spool_(row_bytes, temp_dir, shape, tasks) {}

  void append(const void* rows, size_t count) { spool_.append(rows, count); }
  bool mayPlace() const { return !placed_.isFull(); }
  void place(uint64_t count, std::shared_ptr<RowReader> reader) {
    placed_.add(rows(), count, std::move(reader));
  }
  void finish() { spool_.finish(); }  // before the first read
  uint64_t rows() const { return spool_.rows() + placed_.rows(); }
  uint64_t diskBytes() const { return spool_.diskBytes(); }
  void read(uint64_t first, size_t count, void* out);

 private:
  size_t row_bytes_;
  RowSpool spool_;
  PlacedParts placed_;
};

}  // namespace tetstream
