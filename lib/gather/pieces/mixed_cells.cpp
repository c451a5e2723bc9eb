#include "mixed_cells.h"

#include <algorithm>
#include <cstring>

#include "integer_window.h"
#include "status.h"

namespace tetstream {

namespace {

// Of VTK's ghost marks: the cell is another piece's, was refined, is hidden.
constexpr int64_t kGhostBits = 1 | 8 | 32;

struct KeptCell {
  int64_t points[4];
  uint64_t cell;
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
      ghosts_ = std::make_unique<IntegerWindow>(*marks, piece_.cell_count);
    uint64_t size = piece_.connectivity_size;
    if (mesh.form == CellForm::kOffsets) {
      const MeshArray& offsets = needArray(mesh, piece, piece_.offsets, "offsets");
      size = lastOffset(offsets);
      offsets_ = std::make_unique<IntegerWindow>(offsets, piece_.cell_count);
    }
    points_ = std::make_unique<IntegerWindow>(connectivity, size);
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
  IntegerWindow types_;
  std::unique_ptr<IntegerWindow> ghosts_, offsets_, points_;
  uint64_t begin_ = 0, end_ = 0;
};

void noteCount(MeshPieces& mesh, uint64_t count, const char* text) {
  if (count > 0) mesh.addNote(textOf("%llu %s", static_cast<unsigned long long>(count), text));
}

[[noreturn]] void failType(const MeshPieces& mesh, uint64_t cell, const VtkCell& type,
                           int64_t number, const char* why) {
  fail(Status::kUnsupported, "%s: cell %llu has VTK's type %lld, %s; %s", mesh.name.c_str(),
       static_cast<unsigned long long>(cell), static_cast<long long>(number), type.name, why);
}

// Fills the spools with what stays of the cells.
class CellKeeper {
 public:
  CellKeeper(MeshPieces& mesh, const MixedCellsPlan& plan, RowSpool* spools)
      : mesh_(mesh), plan_(plan), spools_(spools) {}

  void keep(size_t piece) {
    const MeshPiece& p = mesh_.pieces[piece];
    if (p.cell_count == 0) return;
    PieceWalk walk(mesh_, piece);
    for (uint64_t cell = 0; cell < p.cell_count; ++cell) {
      const int64_t number = walk.type(cell);
      const VtkCell& type = vtkCell(number);
      checkType(p.first_cell + cell, type, number);
      const uint64_t points = walk.next(cell);
      if (!stays(type, walk.isGhost(cell))) continue;
      checkPoints(walk, cell, type, points);
      int64_t corners[kMostCorners];
      walk.readCorners(cell, static_cast<size_t>(cornersOf(type.kind.shape)), corners);
      orderVtkCorners(number, corners);
      keepParts(p.first_cell + cell, type.kind, points, corners);
    }
  }

  void tell() {
    noteCount(mesh_, lower_, "cells of lower dimension are left out");
    noteCount(mesh_, empty_, "empty cells are left out");
    noteCount(mesh_, ghosts_,
              "ghost cells, which other pieces have or which are hidden, are left out");
    noteCount(mesh_, higher_, kHigherOrderNote);
    noteCount(mesh_, split_, kSplitNote);
  }

 private:
  void checkType(uint64_t cell, const VtkCell& type, int64_t number) const {
    if (type.fate == VtkCell::kOther)
      failType(mesh_, cell, type, number, "such cells are not read");
    const bool is_cell = type.fate == VtkCell::kKnown && dimensionOf(type.kind.shape) == 3;
    if (is_cell && type.kind.shape != CellShape::kTetra && !plan_.split)
      failType(mesh_, cell, type, number, kOnlyTetrahedra);
  }

  // True if the cell stays; else it is counted.
  bool stays(const VtkCell& type, bool ghost) {
    ghosts_ += ghost;
    if (ghost) return false;
    const bool lower = type.fate == VtkCell::kLower ||
                       (type.fate == VtkCell::kKnown && dimensionOf(type.kind.shape) < 2);
    lower_ += lower;
    empty_ += type.fate == VtkCell::kEmpty;
    return !lower && type.fate != VtkCell::kEmpty;
  }

  void checkPoints(const PieceWalk& walk, uint64_t cell, const VtkCell& type,
                   uint64_t points) const {
    const auto nodes = static_cast<uint64_t>(type.kind.nodes);
    if (points < static_cast<uint64_t>(cornersOf(type.kind.shape)) ||
        (nodes != 0 && points != nodes))
      walk.failCell(cell, textOf("is %s with a wrong number of points", type.name).c_str());
  }

  void keepParts(uint64_t cell, CellKind kind, uint64_t points, int64_t* corners) {
    const auto count = static_cast<size_t>(cornersOf(kind.shape));
    int64_t own[kMostCorners];
    std::copy_n(corners, count, own);
    if (plan_.first_of)
      for (size_t i = 0; i < count; ++i) corners[i] = plan_.first_of(corners[i]);
    const auto ownOf = [&](int64_t corner) {
      return own[std::find(corners, corners + count, corner) - corners];
    };
    const bool face = dimensionOf(kind.shape) == 2;
    KeptCell row = {{}, cell};
    int64_t triangles[2][3], tetrahedra[kMostSplit][4];
    const size_t parts = face ? splitFace(kind.shape, corners, triangles)
                              : splitCell(kind.shape, corners, tetrahedra);
    for (size_t i = 0; i < parts; ++i) {
      std::transform(face ? triangles[i] : tetrahedra[i],
                     face ? triangles[i] + 3 : tetrahedra[i] + 4, row.points, ownOf);
      spools_[face ? MixedCells::kTriangles : MixedCells::kTetrahedra].append(&row, 1);
    }
    if (face) return;
    higher_ += points > count;
    split_ += kind.shape != CellShape::kTetra;
  }

  MeshPieces& mesh_;
  const MixedCellsPlan& plan_;
  RowSpool* spools_;
  uint64_t lower_ = 0, empty_ = 0, ghosts_ = 0, higher_ = 0, split_ = 0;
};

}  // namespace

bool isGhostMarks(const MeshArray& array) {
  return array.components == 1 && !isFloat(array.type) && array.name == "vtkGhostType";
}

const MeshArray* ghostMarks(const MeshPiece& piece) {
  for (const MeshArray& array : piece.cell_data)
    if (isGhostMarks(array)) return &array;
  return nullptr;
}

MixedCells::MixedCells(MeshPieces& mesh, const MixedCellsPlan& plan)
    : spools_{{sizeof(KeptCell), plan.temp_dir}, {sizeof(KeptCell), plan.temp_dir}} {
  CellKeeper keeper(mesh, plan, spools_);
  for (size_t i = 0; i < mesh.pieces.size(); ++i) keeper.keep(i);
  for (RowSpool& spool : spools_) spool.finish();
  if (count(kTetrahedra) == 0 && count(kTriangles) > 0)
    fail(Status::kUnsupported, "%s: there are faces, the first of them cell %llu, but no cells",
         mesh.name.c_str(), static_cast<unsigned long long>(cellAt(kTriangles, 0)));
  keeper.tell();
}

uint64_t MixedCells::cellAt(Kind kind, uint64_t index) {
  KeptCell row;
  std::memcpy(&row, spools_[kind].row(index), sizeof row);
  return row.cell;
}

uint64_t MixedCells::runFrom(Kind kind, uint64_t first, size_t count, size_t* parts) {
  const uint64_t cell = cellAt(kind, first);
  uint64_t last = cell;
  for (*parts = 1; *parts < count; ++*parts) {
    const uint64_t next = cellAt(kind, first + *parts);
    if (next - last > 1) break;
    last = next;
  }
  return last - cell + 1;
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
