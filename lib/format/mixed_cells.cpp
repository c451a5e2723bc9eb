#include "mixed_cells.h"

#include <algorithm>
#include <cstring>

#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kWindowValues = 2048;
constexpr size_t kMostCorners = 4;
// Of VTK's ghost marks: the cell is another piece's, was refined, is hidden.
constexpr int64_t kGhostBits = 1 | 8 | 32;

struct KeptCell {
  int64_t points[kMostCorners];
  uint64_t cell;
};

enum class CellFate { kTetra, kCurved, kTriangle, kLower, kEmpty, kOther };

struct CellType {
  int64_t type;
  const char* name;
  CellFate fate;
  uint64_t points;  // of those that stay; 0: any number
};

constexpr CellType kCellTypes[] = {
    {0, "an empty cell", CellFate::kEmpty, 0},
    {1, "a vertex", CellFate::kLower, 0},
    {2, "a set of vertices", CellFate::kLower, 0},
    {3, "a line", CellFate::kLower, 0},
    {4, "a polyline", CellFate::kLower, 0},
    {5, "a triangle", CellFate::kTriangle, 3},
    {6, "a triangle strip", CellFate::kLower, 0},
    {7, "a polygon", CellFate::kLower, 0},
    {8, "a pixel", CellFate::kLower, 0},
    {9, "a quadrilateral", CellFate::kLower, 0},
    {10, "a tetrahedron", CellFate::kTetra, 4},
    {11, "a voxel", CellFate::kOther, 0},
    {12, "a hexahedron", CellFate::kOther, 0},
    {13, "a wedge", CellFate::kOther, 0},
    {14, "a pyramid", CellFate::kOther, 0},
    {21, "a quadratic line", CellFate::kLower, 0},
    {22, "a quadratic triangle", CellFate::kLower, 0},
    {23, "a quadratic quadrilateral", CellFate::kLower, 0},
    {24, "a quadratic tetrahedron", CellFate::kCurved, 10},
    {25, "a quadratic hexahedron", CellFate::kOther, 0},
    {26, "a quadratic wedge", CellFate::kOther, 0},
    {27, "a quadratic pyramid", CellFate::kOther, 0},
    {28, "a biquadratic quadrilateral", CellFate::kLower, 0},
    {30, "a quadratic linear quadrilateral", CellFate::kLower, 0},
    {34, "a biquadratic triangle", CellFate::kLower, 0},
    {35, "a cubic line", CellFate::kLower, 0},
    {36, "a quadratic polygon", CellFate::kLower, 0},
    {42, "a polyhedron", CellFate::kOther, 0},
    {68, "a Lagrange line", CellFate::kLower, 0},
    {69, "a Lagrange triangle", CellFate::kLower, 0},
    {70, "a Lagrange quadrilateral", CellFate::kLower, 0},
    {71, "a Lagrange tetrahedron", CellFate::kCurved, 0},
    {75, "a Bezier line", CellFate::kLower, 0},
    {76, "a Bezier triangle", CellFate::kLower, 0},
    {77, "a Bezier quadrilateral", CellFate::kLower, 0},
    {78, "a Bezier tetrahedron", CellFate::kCurved, 0},
};

const CellType& typeOf(int64_t type) {
  static constexpr CellType unknown = {-1, "no tetrahedron", CellFate::kOther, 0};
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
  // `n` values, at most kWindowValues, from `first` on, which never goes back: they live until the
  // next call. There must be so many.
  const int64_t* at(uint64_t first, size_t n) {
    if (first + n > begin_ + filled_) {
      begin_ = first;
      filled_ = static_cast<size_t>(std::min<uint64_t>(kWindowValues, count_ - first));
      values_->read(first, filled_, held_, ScalarType::kInt64);
    }
    return held_ + (first - begin_);
  }

 private:
  std::unique_ptr<Values> values_;
  uint64_t count_, begin_ = 0;
  size_t filled_ = 0;
  int64_t held_[kWindowValues];
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

  void readCorners(uint64_t cell, size_t count, int64_t* out) {
    std::copy_n(points_->at(begin_, count), count, out);
    for (size_t i = 0; i < count; ++i) {
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

void noteCount(MeshPieces& mesh, uint64_t count, const char* text) {
  if (count > 0) mesh.addNote(textOf("%llu %s", static_cast<unsigned long long>(count), text));
}

[[noreturn]] void failType(const MeshPieces& mesh, uint64_t cell, const CellType& type,
                           int64_t number) {
  fail(
      Status::kUnsupported,
      "%s: cell %llu has VTK's type %lld, %s; only tetrahedra (types 10, 24, 71, 78) are read, and "
      "triangles (type 5) as faces of theirs",
      mesh.name.c_str(), static_cast<unsigned long long>(cell), static_cast<long long>(number),
      type.name);
}

// True if the cell stays; else it is counted.
bool stays(const CellType& type, bool ghost, Dropped& dropped) {
  dropped.ghosts += ghost;
  if (ghost) return false;
  dropped.lower += type.fate == CellFate::kLower;
  dropped.empty += type.fate == CellFate::kEmpty;
  dropped.curved += type.fate == CellFate::kCurved;
  return type.fate != CellFate::kLower && type.fate != CellFate::kEmpty;
}

void keepCells(const MeshPieces& mesh, size_t piece, RowSpool* spools, Dropped& dropped) {
  const MeshPiece& p = mesh.pieces[piece];
  if (p.cell_count == 0) return;
  PieceWalk walk(mesh, piece);
  for (uint64_t cell = 0; cell < p.cell_count; ++cell) {
    const CellType& type = typeOf(walk.type(cell));
    if (type.fate == CellFate::kOther) failType(mesh, p.first_cell + cell, type, walk.type(cell));
    const uint64_t points = walk.next(cell);
    if (!stays(type, walk.isGhost(cell), dropped)) continue;
    const bool triangle = type.fate == CellFate::kTriangle;
    const size_t corners = triangle ? 3 : 4;
    if (points < corners || (type.points != 0 && points != type.points))
      walk.failCell(cell, triangle ? "is a triangle with a wrong number of points"
                                   : "is a tetrahedron with a wrong number of points");
    KeptCell row = {};
    walk.readCorners(cell, corners, row.points);
    row.cell = p.first_cell + cell;
    spools[triangle ? MixedCells::kTriangles : MixedCells::kTetrahedra].append(&row, 1);
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
    : spools_{{sizeof(KeptCell), temp_dir}, {sizeof(KeptCell), temp_dir}} {
  Dropped dropped;
  for (size_t i = 0; i < mesh.pieces.size(); ++i) keepCells(mesh, i, spools_, dropped);
  for (RowSpool& spool : spools_) spool.finish();
  if (count(kTetrahedra) == 0 && count(kTriangles) > 0)
    failType(mesh, cellAt(kTriangles, 0), typeOf(kVtkTriangle), kVtkTriangle);
  noteCount(mesh, dropped.lower, "cells of lower dimension are left out");
  noteCount(mesh, dropped.empty, "empty cells are left out");
  noteCount(mesh, dropped.ghosts,
            "ghost cells, which other pieces have or which are hidden, are left out");
  noteCount(mesh, dropped.curved, "curved tetrahedra are taken by their corners");
}

uint64_t MixedCells::cellAt(Kind kind, uint64_t index) {
  KeptCell row;
  std::memcpy(&row, spools_[kind].row(index), sizeof row);
  return row.cell;
}

void MixedCells::readPoints(Kind kind, uint64_t first, size_t count, int64_t* out) {
  const size_t corners = kind == kTriangles ? 3 : 4;
  for (size_t i = 0; i < count; ++i) {
    KeptCell row;
    std::memcpy(&row, spools_[kind].row(first + i), sizeof row);
    std::copy_n(row.points, corners, out + corners * i);
  }
}

}  // namespace tetstream
