#include "mixed_cells.h"

#include <algorithm>
#include <cstring>

#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kAtOnce = 2048;  // values
constexpr size_t kCorners = 4;
// Of VTK's ghost marks: the cell is another piece's, was refined, is hidden.
constexpr int64_t kGhostBits = 1 | 8 | 32;

struct KeptRow {
  int64_t points[kCorners];
  uint64_t cell;
};

enum class Kind { kTetra, kCurved, kLower, kEmpty, kOther };

struct CellType {
  int64_t type;
  const char* name;
  Kind kind;
  uint64_t points;  // of tetrahedra; 0: any number
};

constexpr CellType kCellTypes[] = {
    {0, "an empty cell", Kind::kEmpty, 0},
    {1, "a vertex", Kind::kLower, 0},
    {2, "a set of vertices", Kind::kLower, 0},
    {3, "a line", Kind::kLower, 0},
    {4, "a polyline", Kind::kLower, 0},
    {5, "a triangle", Kind::kLower, 0},
    {6, "a triangle strip", Kind::kLower, 0},
    {7, "a polygon", Kind::kLower, 0},
    {8, "a pixel", Kind::kLower, 0},
    {9, "a quadrilateral", Kind::kLower, 0},
    {10, "a tetrahedron", Kind::kTetra, 4},
    {11, "a voxel", Kind::kOther, 0},
    {12, "a hexahedron", Kind::kOther, 0},
    {13, "a wedge", Kind::kOther, 0},
    {14, "a pyramid", Kind::kOther, 0},
    {21, "a quadratic line", Kind::kLower, 0},
    {22, "a quadratic triangle", Kind::kLower, 0},
    {23, "a quadratic quadrilateral", Kind::kLower, 0},
    {24, "a quadratic tetrahedron", Kind::kCurved, 10},
    {25, "a quadratic hexahedron", Kind::kOther, 0},
    {26, "a quadratic wedge", Kind::kOther, 0},
    {27, "a quadratic pyramid", Kind::kOther, 0},
    {28, "a biquadratic quadrilateral", Kind::kLower, 0},
    {30, "a quadratic linear quadrilateral", Kind::kLower, 0},
    {34, "a biquadratic triangle", Kind::kLower, 0},
    {35, "a cubic line", Kind::kLower, 0},
    {36, "a quadratic polygon", Kind::kLower, 0},
    {42, "a polyhedron", Kind::kOther, 0},
    {68, "a Lagrange line", Kind::kLower, 0},
    {69, "a Lagrange triangle", Kind::kLower, 0},
    {70, "a Lagrange quadrilateral", Kind::kLower, 0},
    {71, "a Lagrange tetrahedron", Kind::kCurved, 0},
    {75, "a Bezier line", Kind::kLower, 0},
    {76, "a Bezier triangle", Kind::kLower, 0},
    {77, "a Bezier quadrilateral", Kind::kLower, 0},
    {78, "a Bezier tetrahedron", Kind::kCurved, 0},
};

const CellType& typeOf(int64_t type) {
  static constexpr CellType unknown = {-1, "no tetrahedron", Kind::kOther, 0};
  for (const CellType& row : kCellTypes)
    if (row.type == type) return row;
  return unknown;
}

// Integers of an array in sequence, some thousands read at once.
class Window {
 public:
  Window(const MeshArray& array, uint64_t count)
      : values_(count > 0 ? array.open(count) : nullptr), count_(count) {}
  uint64_t count() const { return count_; }
  // `n` values, at most kAtOnce, from `first` on, which never goes back: they live until the next
  // call. There must be so many.
  const int64_t* at(uint64_t first, size_t n) {
    if (first + n > begin_ + filled_) {
      begin_ = first;
      filled_ = static_cast<size_t>(std::min<uint64_t>(kAtOnce, count_ - first));
      values_->read(first, filled_, held_, ScalarType::kInt64);
    }
    return held_ + (first - begin_);
  }

 private:
  std::unique_ptr<Values> values_;
  uint64_t count_, begin_ = 0;
  size_t filled_ = 0;
  int64_t held_[kAtOnce];
};

const MeshArray& needArray(const MeshPieces& mesh, size_t piece,
                           const std::optional<MeshArray>& array, const char* name) {
  if (!array) fail(Status::kBadData, "%s: piece %zu has no %s", mesh.name.c_str(), piece, name);
  return *array;
}

// The cells of one piece, one after the other.
class PieceWalk {
 public:
  PieceWalk(const MeshPieces& mesh, size_t piece)
      : mesh_(mesh),
        piece_(mesh.pieces[piece]),
        types_(needArray(mesh, piece, piece_.types, "types"), piece_.cell_count) {
    const MeshArray& connectivity = needArray(mesh, piece, piece_.connectivity, "connectivity");
    if (const MeshArray* marks = ghostMarks(piece_))
      ghosts_ = std::make_unique<Window>(*marks, piece_.cell_count);
    uint64_t size = piece_.connectivity_size;
    if (mesh.form == CellForm::kOffsets) {
      const MeshArray& offsets = needArray(mesh, piece, piece_.offsets, "offsets");
      size = lastOffset(offsets);
      offsets_ = std::make_unique<Window>(offsets, piece_.cell_count);
    }
    points_ = std::make_unique<Window>(connectivity, size);
  }

  int64_t type(uint64_t cell) { return *types_.at(cell, 1); }
  bool isGhost(uint64_t cell) { return ghosts_ && (*ghosts_->at(cell, 1) & kGhostBits) != 0; }

  // Goes to the next cell and returns its number of points.
  uint64_t next(uint64_t cell) {
    if (offsets_) {
      begin_ = end_;
      const int64_t end = *offsets_->at(cell, 1);
      if (end < 0 || static_cast<uint64_t>(end) < begin_) failCell(cell, "has a wrong offset");
      end_ = static_cast<uint64_t>(end);
    } else {
      begin_ = end_ + 1;
      if (end_ >= points_->count()) failCell(cell, "is not in the list of cells, which ends");
      const int64_t count = *points_->at(end_, 1);
      if (count < 0 || static_cast<uint64_t>(count) > points_->count() - begin_)
        failCell(cell, "has a wrong number of points");
      end_ = begin_ + static_cast<uint64_t>(count);
    }
    if (end_ > points_->count()) failCell(cell, "has a wrong offset");
    return end_ - begin_;
  }

  void readCorners(uint64_t cell, int64_t out[kCorners]) {
    std::copy_n(points_->at(begin_, kCorners), kCorners, out);
    for (size_t i = 0; i < kCorners; ++i) {
      if (static_cast<uint64_t>(out[i]) >= piece_.point_count)
        fail(Status::kBadData, "%s: cell %llu uses point %lld, there are %llu", mesh_.name.c_str(),
             static_cast<unsigned long long>(piece_.first_cell + cell),
             static_cast<long long>(out[i]), static_cast<unsigned long long>(piece_.point_count));
      out[i] += static_cast<int64_t>(piece_.first_point);
    }
  }

  [[noreturn]] void failCell(uint64_t cell, const char* text) const {
    fail(Status::kBadData, "%s: cell %llu %s", mesh_.name.c_str(),
         static_cast<unsigned long long>(piece_.first_cell + cell), text);
  }

 private:
  uint64_t lastOffset(const MeshArray& offsets) const {
    int64_t last;
    offsets.open(piece_.cell_count)->read(piece_.cell_count - 1, 1, &last, ScalarType::kInt64);
    if (last < 0 || static_cast<uint64_t>(last) > kMaxMeshCount)
      failCell(piece_.cell_count - 1, "has a wrong offset");
    return static_cast<uint64_t>(last);
  }

  const MeshPieces& mesh_;
  const MeshPiece& piece_;
  Window types_;
  std::unique_ptr<Window> ghosts_, offsets_, points_;
  uint64_t begin_ = 0, end_ = 0;
};

struct Dropped {
  uint64_t lower = 0, empty = 0, ghosts = 0, curved = 0;
};

void addCount(MeshPieces& mesh, uint64_t count, const char* text) {
  if (count > 0) mesh.addNote(textOf("%llu %s", static_cast<unsigned long long>(count), text));
}

void keepCells(const MeshPieces& mesh, size_t piece, RowSpool& spool, Dropped& dropped) {
  const MeshPiece& p = mesh.pieces[piece];
  if (p.cell_count == 0) return;
  PieceWalk walk(mesh, piece);
  for (uint64_t cell = 0; cell < p.cell_count; ++cell) {
    const CellType& type = typeOf(walk.type(cell));
    if (type.kind == Kind::kOther)
      fail(Status::kUnsupported,
           "%s: cell %llu has VTK's type %lld, %s; only tetrahedra (types 10, 24, 71) are read",
           mesh.name.c_str(), static_cast<unsigned long long>(p.first_cell + cell),
           static_cast<long long>(walk.type(cell)), type.name);
    const uint64_t points = walk.next(cell);
    const bool ghost = walk.isGhost(cell);
    dropped.ghosts += ghost;
    dropped.lower += !ghost && type.kind == Kind::kLower;
    dropped.empty += !ghost && type.kind == Kind::kEmpty;
    if (ghost || type.kind == Kind::kLower || type.kind == Kind::kEmpty) continue;
    dropped.curved += type.kind == Kind::kCurved;
    if (points < kCorners || (type.points != 0 && points != type.points))
      walk.failCell(cell, "is a tetrahedron with a wrong number of points");
    KeptRow row;
    walk.readCorners(cell, row.points);
    row.cell = p.first_cell + cell;
    spool.append(&row, 1);
  }
}

}  // namespace

bool isGhostMarks(const MeshArray& array) {
  return array.components == 1 && !isFloat(array.type) && array.name == "vtkGhostType";
}

const MeshArray* ghostMarks(const MeshPiece& piece) {
  for (const MeshArray& array : piece.cell_data)
    if (isGhostMarks(array)) return &array;
  return nullptr;
}

MixedCells::MixedCells(MeshPieces& mesh, const std::string& temp_dir)
    : spool_(sizeof(KeptRow), temp_dir) {
  Dropped dropped;
  for (size_t i = 0; i < mesh.pieces.size(); ++i) keepCells(mesh, i, spool_, dropped);
  spool_.finish();
  addCount(mesh, dropped.lower, "cells of lower dimension are left out");
  addCount(mesh, dropped.empty, "empty cells are left out");
  addCount(mesh, dropped.ghosts,
           "ghost cells, which other pieces have or which are hidden, are "
           "left out");
  addCount(mesh, dropped.curved, "curved tetrahedra are taken by their corners");
}

uint64_t MixedCells::cellAt(uint64_t index) {
  KeptRow row;
  std::memcpy(&row, spool_.row(index), sizeof row);
  return row.cell;
}

void MixedCells::readCells(uint64_t first, size_t count, int64_t* out) {
  for (size_t i = 0; i < count; ++i) {
    KeptRow row;
    std::memcpy(&row, spool_.row(first + i), sizeof row);
    std::copy_n(row.points, kCorners, out + kCorners * i);
  }
}

}  // namespace tetstream
