// format/gmsh: Gmsh's numbers of kinds of cells. Depends on cell_kinds.h.
#pragma once

#include "cell_kinds.h"

namespace tetstream {

constexpr int kMshTetra = 4, kMshTriangle = 2;

// Null: none that is known.
const CellKind* mshKind(int64_t number);

}  // namespace tetstream
