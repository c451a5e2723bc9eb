// gather/pieces: tetrahedra that stand as rows of five numbers, the first of them 4. Depends on
// mesh_pieces.h.
#pragma once

#include "mesh_pieces.h"

namespace tetstream {

// Makes the connectivity of a piece of kInterleaved cells, all of them tetrahedra, that of their
// points alone. `name` is the file's, for messages.
void dropCounts(const std::string& name, MeshPiece& piece);

}  // namespace tetstream
