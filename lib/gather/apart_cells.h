// gather: whether the cells of a mesh share no points, as fields that jump between cells are
// written. Depends on mesh_pieces.h.
#pragma once

#include "mesh_pieces.h"

namespace tetstream {

// Every cell has points of its own: they follow each other as the cells do. More than a few cells.
bool cellsAreApart(const MeshPieces& mesh);

}  // namespace tetstream
