#include "apart_cells.h"

#include <algorithm>
#include <utility>

#include "rows_at_once.h"

namespace tetstream {

namespace {

constexpr uint64_t kLeastCells = 16;   // fewer may well be apart in truth
constexpr uint64_t kFewestPoints = 3;  // of a cell, as a rule; joined ones have hardly two
constexpr int64_t kMostPoints = 32;    // of a cell, with what lies between its corners

// How many points the cells name.
uint64_t namesOf(const MeshPieces& mesh, const MeshPiece& piece) {
  if (mesh.form == CellForm::kTetrahedra) return 4 * piece.cell_count;
  if (mesh.form == CellForm::kInterleaved) return piece.connectivity_size - piece.cell_count;
  int64_t end = 0;
  if (piece.offsets)
    piece.offsets->open(piece.cell_count)->read(piece.cell_count - 1, 1, &end, ScalarType::kInt64);
  return end > 0 ? static_cast<uint64_t>(end) : 0;
}

// Whether each point is named once, near its own place: within a cell the order is anything.
class ApartPoints {
 public:
  ApartPoints() { std::fill_n(recent_, kMostPoints, int64_t{-1}); }
  bool takes(int64_t point) {
    const int64_t away = point - next_++;
    if (point < 0 || away <= -kMostPoints / 2 || away >= kMostPoints / 2) return false;
    int64_t& before = recent_[point % kMostPoints];
    return std::exchange(before, point) != point;
  }

 private:
  int64_t next_ = 0, recent_[kMostPoints];
};

bool isApart(const MeshPiece& piece, uint64_t values, bool with_counts) {
  const auto opened = piece.connectivity->open(values);
  int64_t held[kRowsAtOnce], left = 0;  // of a cell, where their number comes first
  ApartPoints points;
  for (uint64_t at = 0; at < values; at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, values - at));
    opened->read(at, n, held, ScalarType::kInt64);
    for (size_t i = 0; i < n; ++i)
      if (with_counts && left == 0)
        left = held[i];
      else if (--left; !points.takes(held[i]))
        return false;
  }
  return true;
}

}  // namespace

bool cellsAreApart(const MeshPieces& mesh) {
  if (mesh.cell_count < kLeastCells || mesh.point_count / kFewestPoints < mesh.cell_count)
    return false;
  const bool with_counts = mesh.form == CellForm::kInterleaved;
  for (const MeshPiece& piece : mesh.pieces) {
    if (piece.cell_count == 0) continue;
    const uint64_t names = piece.connectivity ? namesOf(mesh, piece) : 0;
    if (names == 0 || names != piece.point_count) return false;
    if (!isApart(piece, names + (with_counts ? piece.cell_count : 0), with_counts)) return false;
  }
  return true;
}

}  // namespace tetstream
