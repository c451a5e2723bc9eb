// gather/pieces: the tetrahedra and the triangles among the cells of a file that has others, too,
// or ghosts: kept in temporary files, so that they can be read by range. Depends on mesh_pieces.h,
// row_spool.h.
#pragma once

#include <cstring>
#include <functional>
#include <string>

#include "mesh_pieces.h"
#include "row_spool.h"
#include "vtk_cells.h"

namespace tetstream {

// The array of VTK's ghost marks, which names cells that other pieces have, too; null without.
const MeshArray* ghostMarks(const MeshPiece& piece);
bool isGhostMarks(const MeshArray& array);

struct MixedCellsPlan {
  std::string temp_dir;
  bool split = false;  // cells that are no tetrahedra; else they are errors
  // The first of the points that are one; empty: none are. Cells are split by these, so that those
  // on both sides of a face that pieces share are cut alike.
  std::function<int64_t(int64_t)> first_of;
};

class MixedCells {
 public:
  // Reads all types and the points of the cells that stay, tetrahedra and what becomes them, and of
  // the faces, which become triangles; of curved ones the corners. Other cells of lower dimension,
  // ghosts and empty ones are left out with a note in `mesh`; any other throws kUnsupported with
  // the cell's number, and so do faces alone.
  MixedCells(MeshPieces& mesh, const MixedCellsPlan& plan);

  enum Kind { kTetrahedra, kTriangles };
  uint64_t count(Kind kind) const { return spools_[kind].rows(); }
  // The points, four or three each, are numbered over all pieces.
  void readPoints(Kind kind, uint64_t first, size_t count, int64_t* out);
  // Rows of what the file says of its cells, for each part of a cell the same: read(cell, n, to)
  // reads those of n cells from `cell` on.
  template <class Read>
  void readRows(Kind kind, uint64_t first, size_t count, size_t row_bytes, void* out, Read read) {
    auto* to = static_cast<unsigned char*>(out);
    for (size_t n; count > 0; first += n, count -= n, to += n * row_bytes) {
      const uint64_t cell = cellAt(kind, first);
      const uint64_t cells = runFrom(kind, first, count, &n);
      read(cell, static_cast<size_t>(cells), static_cast<void*>(to));
      // From the back: no part's row lies behind its own place.
      for (size_t i = cells < n ? n : 0; i-- > 0;)
        std::memmove(to + i * row_bytes, to + (cellAt(kind, first + i) - cell) * row_bytes,
                     row_bytes);
    }
  }

 private:
  uint64_t cellAt(Kind kind, uint64_t index);
  // The parts, `count` at most, of cells that follow each other in the file; returns how many
  // cells.
  uint64_t runFrom(Kind kind, uint64_t first, size_t count, size_t* parts);

  RowSpool spools_[2];
};

}  // namespace tetstream
