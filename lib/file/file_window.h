// file: rows of one width that lie one after the other in a file, read by range. Depends on
// bytes.h.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "bytes.h"

namespace tetstream {

// The bytes of a file that were asked for last, and some behind them: columns that lie in the same
// rows are read from the file together.
class FileWindow {
 public:
  static constexpr size_t kMostBytes = 256 << 10;  // stays in the processor's cache

  explicit FileWindow(std::shared_ptr<ByteSource> file) : file_(std::move(file)) {}
  // Bytes [offset, offset + size), of kMostBytes at most; they live until the next call. Throws
  // kBadData where the file has become shorter.
  const unsigned char* bytes(uint64_t offset, size_t size);

  const ByteSource& file() const { return *file_; }

 private:
  std::shared_ptr<ByteSource> file_;
  std::vector<unsigned char> held_;
  uint64_t begin_ = 0;  // in the file, of what is held
  size_t size_ = 0;     // of that
};

// Where rows lie that were passed over. All of them were in the file then.
struct RowsPlace {
  std::shared_ptr<ByteSource> file;
  uint64_t begin = 0, rows = 0;
  size_t row_bytes = 1;  // at most FileWindow::kMostBytes
  bool swapped = false;  // the bytes of each number

  uint64_t end() const { return begin + rows * row_bytes; }
};

// visit(pointer to the bytes of some rows, how many, the first one's number) for rows [first, first
// + count), in order, as long as it returns true.
template <class Visit>
void forPlacedRows(FileWindow& window, const RowsPlace& place, uint64_t first, uint64_t count,
                   Visit visit) {
  for (uint64_t end = first + count; first < end;) {
    const auto n = static_cast<size_t>(
        std::min<uint64_t>(end - first, FileWindow::kMostBytes / place.row_bytes));
    if (!visit(window.bytes(place.begin + first * place.row_bytes, n * place.row_bytes), n, first))
      return;
    first += n;
  }
}

}  // namespace tetstream
