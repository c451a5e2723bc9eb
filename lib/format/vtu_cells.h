// format: which cells of a .vtu file are tetrahedra and which are triangles, and their points.
// Depends on vtu_column.h.
#pragma once

#include "memory.h"
#include "vtu_column.h"

namespace tetstream {

enum class VtuKind { kTetrahedron, kTriangle };

// Each kind is numbered by itself, over all pieces. Where there are only tetrahedra, which the size
// of the connectivity tells, nothing is read beforehand; otherwise the types are, and memory grows
// with how often kinds take turns in the file.
class VtuCells {
 public:
  // Throws kUnsupported, naming the cell, for other types that are met.
  VtuCells(ByteSource& bytes, const VtuFile& file);

  uint64_t count(VtuKind kind) const { return counts_[static_cast<size_t>(kind)]; }
  // The points of cells [first, first + count), four or three each, as the whole file numbers them;
  // types, offsets and points are checked.
  void readPoints(VtuKind kind, uint64_t first, size_t count, int64_t* out);
  // visit(first, count) for each run of such cells, as they are numbered among all.
  template <class Visit>
  void visitRuns(VtuKind kind, uint64_t first, size_t count, Visit visit) const {
    checkRange(kind, first, count);
    for (size_t at = count > 0 ? runAt(kind, first) : 0; count > 0; ++at) {
      const Run& run = runsOf(kind)[at];
      const uint64_t before = first - run.first;
      const auto cells = static_cast<size_t>(std::min<uint64_t>(run.count - before, count));
      visit(run.first_cell + before, cells);
      first += cells;
      count -= cells;
    }
  }

 private:
  // Cells of a kind that follow each other in one piece.
  struct Run {
    uint64_t first, count;  // of the kind
    uint64_t first_cell;    // among all
    uint64_t first_value;   // in the piece's connectivity
    size_t piece;
  };

  static constexpr size_t kKinds = 2;
  const Run* runsOf(VtuKind kind) const { return runs_[static_cast<size_t>(kind)].data(); }
  size_t runAt(VtuKind kind, uint64_t first) const;
  void checkRange(VtuKind kind, uint64_t first, size_t count) const;
  void addPiece(size_t piece);
  bool holdsOnlyTetrahedra(size_t piece);
  void readTypes(size_t piece);
  void add(VtuKind kind, size_t piece, uint64_t cell, uint64_t count, uint64_t value);
  void openConnectivity(size_t piece);
  void readRun(VtuKind kind, const Run& run, uint64_t before, size_t count, int64_t* out);
  void checkTypes(VtuKind kind, uint64_t first, size_t count);
  void checkOffsets(VtuKind kind, const Run& run, uint64_t before, size_t count);
  [[noreturn]] void failType(uint64_t cell, int64_t type) const;

  ByteSource& bytes_;
  const VtuFile& file_;
  VtuColumn offsets_, types_;
  VtuColumnPlan connectivity_plan_;
  Account account_;
  Array<Run> runs_[kKinds];
  size_t run_counts_[kKinds] = {0, 0};
  uint64_t counts_[kKinds] = {0, 0};
  uint64_t checked_[kKinds] = {0, 0};  // cells of the kind before are known to be good
  std::vector<uint64_t> values_;       // of the connectivity of each piece
  size_t piece_ = SIZE_MAX;            // whose connectivity is open
  std::unique_ptr<VtuValues> connectivity_;
};

}  // namespace tetstream
