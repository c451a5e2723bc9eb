#include "counted_cells.h"

#include <limits>

namespace tetstream {

bool CountedCells::serves(const IndexedSource& source, size_t memory_bytes) {
  const auto cells = static_cast<uint64_t>(source.schema().cell_count);
  const auto points = static_cast<uint64_t>(source.schema().vertex_count);
  return source.randomAccess() && cells <= std::numeric_limits<uint32_t>::max() &&
         (cells + 2 * points + 1) * sizeof(uint32_t) <= memory_bytes;
}

CountedCells::CountedCells(IndexedSource& source, const Array<uint32_t>& ranks, uint64_t vertices,
                           Account& account, const Tell& tell)
    : cells_(account, static_cast<size_t>(source.schema().cell_count)) {
  const auto highest = [&ranks](const int64_t* c) {
    const auto rank = [&](int j) { return ranks[static_cast<size_t>(c[j])]; };
    return std::max(std::max(rank(0), rank(1)), std::max(rank(2), rank(3)));
  };
  // starts[r]: the place of the next cell whose highest rank is r.
  Array<uint32_t> starts(account, static_cast<size_t>(vertices));
  std::fill_n(starts.data(), starts.size(), 0u);
  readAllCells(
      source, [&](double share) { tell(0.5 * share); },
      [&](uint64_t, size_t count, const int64_t* corners) {
        for (size_t i = 0; i < count; ++i) ++starts[highest(corners + 4 * i)];
      });
  uint32_t sum = 0;
  for (size_t r = 0; r < starts.size(); ++r) sum += std::exchange(starts[r], sum);
  readAllCells(
      source, [&](double share) { tell(0.5 + 0.5 * share); },
      [&](uint64_t first, size_t count, const int64_t* corners) {
        for (size_t i = 0; i < count; ++i)
          cells_[starts[highest(corners + 4 * i)]++] = static_cast<uint32_t>(first + i);
      });
}

}  // namespace tetstream
