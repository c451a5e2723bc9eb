// gather/kinds: VTK's numbers of cell types, which SU2 uses, too. Depends on cell_kinds.h.
#pragma once

#include "cell_kinds.h"

namespace tetstream {

constexpr int kVtkTetra = 10, kVtkTriangle = 5;  // linear

struct VtkCell {
  enum Fate {
    kKnown,  // has a kind, with as many nodes, or of those with 0 as many as the file says
    kLower,  // of lower dimension, and no face that we read
    kEmpty,
    kOther,
  };
  int64_t type;
  const char* name;  // "a hexahedron"
  Fate fate;
  CellKind kind;
};

const VtkCell& vtkCell(int64_t type);

// Pixels and voxels, whose corners go in rows. They are made to go round as in other cells, and so
// are linear wedges, whose first face goes round the other way, seen from within.
bool hasRowCorners(int64_t type);
void orderVtkCorners(int64_t type, int64_t* corners);

}  // namespace tetstream
