// layout: an indexed mesh, read from end to end in pieces. Depends on stream.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "source.h"

namespace tetstream {

constexpr size_t kRowsOfPiece = 16384;

// A share of something that is done; may throw to stop.
using Tell = std::function<void(double)>;

// visit(first, count) for each piece of `rows` rows.
template <class Visit>
void readInPieces(uint64_t rows, const Tell& tell, Visit visit) {
  for (uint64_t at = 0; at < rows; at += kRowsOfPiece) {
    visit(at, static_cast<size_t>(std::min<uint64_t>(kRowsOfPiece, rows - at)));
    tell(static_cast<double>(at) / static_cast<double>(rows));
  }
}

// Throws kBadData where the corners are not four different points of the mesh.
void refuseCell(const IndexedSource& source, uint64_t cell, const int64_t corners[4]);

inline void checkCell(const IndexedSource& source, uint64_t cell, const int64_t corners[4],
                      int64_t points) {
  bool is_good = true;
  for (int j = 0; j < 4; ++j) {
    is_good &= static_cast<uint64_t>(corners[j]) < static_cast<uint64_t>(points);
    for (int i = 0; i < j; ++i) is_good &= corners[i] != corners[j];
  }
  if (!is_good) refuseCell(source, cell, corners);
}

// visit(first, count, corners [count][4]), of each cell four different points of the mesh.
template <class Visit>
void readAllCells(IndexedSource& source, const Tell& tell, Visit visit) {
  const auto cells = static_cast<uint64_t>(source.schema().cell_count);
  const int64_t points = source.schema().vertex_count;
  std::vector<int64_t> corners(4 * std::min<uint64_t>(kRowsOfPiece, cells));
  readInPieces(cells, tell, [&](uint64_t first, size_t count) {
    source.readCells(first, count, corners.data());
    for (size_t i = 0; i < count; ++i) checkCell(source, first + i, &corners[4 * i], points);
    visit(first, count, corners.data());
  });
}

}  // namespace tetstream
