// format: the tetrahedra and the triangles among the cells of a file that has others, too, or
// ghosts: kept in temporary files, so that they can be read by range. Depends on mesh_pieces.h,
// row_spool.h.
#pragma once

#include <string>

#include "mesh_pieces.h"
#include "row_spool.h"
#include "vtk_cells.h"

namespace tetstream {

// The array of VTK's ghost marks, which names cells that other pieces have, too; null without.
const MeshArray* ghostMarks(const MeshPiece& piece);
bool isGhostMarks(const MeshArray& array);

class MixedCells {
 public:
  // Reads all types and the points of the cells that stay: triangles and tetrahedra, of curved ones
  // the corners. Other cells of lower dimension, ghosts and empty ones are left out with a note in
  // `mesh`; any other throws kUnsupported with the cell's number, and so do triangles alone.
  MixedCells(MeshPieces& mesh, const std::string& temp_dir);

  enum Kind { kTetrahedra, kTriangles };
  uint64_t count(Kind kind) const { return spools_[kind].rows(); }
  // The points, four or three each, are numbered over all pieces.
  void readPoints(Kind kind, uint64_t first, size_t count, int64_t* out);
  // Calls read(cell, n, at) for runs of cells that follow each other in the file: n cells from
  // `cell` on are those from first + at on here.
  template <class Read>
  void forRuns(Kind kind, uint64_t first, size_t count, Read read) {
    for (size_t at = 0; at < count;) {
      const uint64_t cell = cellAt(kind, first + at);
      size_t n = 1;
      while (at + n < count && cellAt(kind, first + at + n) == cell + n) ++n;
      read(cell, n, at);
      at += n;
    }
  }

 private:
  uint64_t cellAt(Kind kind, uint64_t index);

  RowSpool spools_[2];
};

}  // namespace tetstream
