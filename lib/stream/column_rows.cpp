#include "column_rows.h"

#include <algorithm>
#include <iterator>

namespace tetstream {

void PlacedParts::add(uint64_t rank, uint64_t count, std::shared_ptr<RowReader> reader) {
  if (count == 0) return;
  parts_.push_back({rank, count, rows_, std::move(reader)});
  rows_ += count;
}

// The rows from `first` on that are of one kind, and of one part.
PlacedParts::Run PlacedParts::runFrom(uint64_t first, size_t most) const {
  const auto next = std::upper_bound(parts_.begin(), parts_.end(), first,
                                     [](uint64_t rank, const Part& p) { return rank < p.rank; });
  const auto rowsUpTo = [&](uint64_t end) {
    return static_cast<size_t>(std::min<uint64_t>(most, end - first));
  };
  uint64_t before = 0;
  if (next != parts_.begin()) {
    const Part& part = *std::prev(next);
    if (first - part.rank < part.count)
      return {part.reader.get(), first - part.rank, rowsUpTo(part.rank + part.count)};
    before = part.before + part.count;
  }
  return {nullptr, first - before, next == parts_.end() ? most : rowsUpTo(next->rank)};
}

void ColumnRows::read(uint64_t first, size_t count, void* out) {
  placed_.read(first, count, row_bytes_, out,
               [this](uint64_t index, size_t n, unsigned char* to) { spool_.read(index, n, to); });
}

}  // namespace tetstream
