#include "cell_points.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "integer_window.h"
#include "point_set.h"
#include "vtk_cells.h"

namespace tetstream {

namespace {

constexpr uint64_t kLeastCells = 16;   // fewer may well be apart in truth
constexpr uint64_t kFewestPoints = 3;  // of a cell, as a rule; joined ones have hardly two
constexpr int64_t kMostPoints = 64;    // of a cell that is read

// The cells of one piece, each as the numbers of its points.
class PieceCells {
 public:
  PieceCells(const MeshPieces& mesh, const MeshPiece& piece) : form_(mesh.form) {
    if (form_ == CellForm::kOffsets && piece.offsets)
      ends_.emplace(*piece.offsets, piece.cell_count);
    if (form_ != CellForm::kTetrahedra && piece.types)
      types_.emplace(*piece.types, piece.cell_count);
    if (piece.connectivity) names_.emplace(*piece.connectivity, namesOf(piece));
  }

  // The next one of three dimensions that is whole; false: there is none.
  bool next(std::vector<int64_t>& points) {
    for (;;) {
      points.clear();
      if (!names_ || names_->hasEnded() || (types_ && types_->hasEnded())) return false;
      const bool is_solid = !types_ || isSolid(types_->next());
      int64_t count = countOfNext();
      ++cells_;
      if (count < 0) return false;
      const bool is_wanted = is_solid && count <= kMostPoints;
      for (; count > 0 && !names_->hasEnded(); --count) {
        const int64_t point = names_->next();
        if (is_wanted) points.push_back(point);
      }
      if (count > 0) return false;
      if (is_wanted) return true;
    }
  }
  uint64_t cells() const { return cells_; }  // that were passed

 private:
  static bool isSolid(int64_t type) {
    const VtkCell& cell = vtkCell(type);
    return cell.fate == VtkCell::kKnown && dimensionOf(cell.kind.shape) == 3;
  }

  int64_t countOfNext() {
    if (form_ == CellForm::kInterleaved) return names_->next();
    if (form_ == CellForm::kTetrahedra) return 4;
    const int64_t begin = std::exchange(end_, ends_->next());
    return end_ - begin;
  }

  uint64_t namesOf(const MeshPiece& piece) const {
    if (form_ == CellForm::kTetrahedra) return 4 * piece.cell_count;
    if (form_ == CellForm::kInterleaved) return piece.connectivity_size;
    int64_t end = 0;
    if (piece.offsets)
      piece.offsets->open(piece.cell_count)
          ->read(piece.cell_count - 1, 1, &end, ScalarType::kInt64);
    return end > 0 ? static_cast<uint64_t>(end) : 0;
  }

  CellForm form_;
  std::optional<IntegerWindow> ends_, names_, types_;
  int64_t end_ = 0;
  uint64_t cells_ = 0;
};

bool isApart(const MeshPieces& mesh, const MeshPiece& piece, Account& account) {
  PointSet named(account, piece.point_count);
  PieceCells cells(mesh, piece);
  std::vector<int64_t> points;
  while (cells.next(points))
    for (const int64_t point : points) {
      const auto number = static_cast<uint64_t>(point);
      if (number >= piece.point_count || !named.add(number)) return false;
    }
  return cells.cells() == piece.cell_count;
}

}  // namespace

bool cellsAreApart(const MeshPieces& mesh) {
  if (mesh.cell_count < kLeastCells || mesh.point_count / kFewestPoints < mesh.cell_count)
    return false;
  Account account;
  return std::all_of(mesh.pieces.begin(), mesh.pieces.end(), [&](const MeshPiece& piece) {
    return piece.cell_count == 0 || isApart(mesh, piece, account);
  });
}

std::optional<uint64_t> cellThatLosesACorner(const MeshPieces& mesh, PointJoin& joined) {
  std::vector<int64_t> points;
  for (const MeshPiece& piece : mesh.pieces) {
    if (piece.cell_count == 0) continue;
    PieceCells cells(mesh, piece);
    while (cells.next(points)) {
      const auto count = static_cast<int64_t>(piece.point_count);
      std::erase_if(points, [count](int64_t point) { return point < 0 || point >= count; });
      for (int64_t& point : points) point += static_cast<int64_t>(piece.first_point);
      if (losesACorner(points, joined)) return piece.first_cell + cells.cells() - 1;
    }
  }
  return {};
}

}  // namespace tetstream
