// gather/pieces: the tetrahedra of an indexed mesh of pieces as one mesh, end to end, in memory
// that does not depend on the mesh's size. Depends on mesh_pieces.h, source.h.
#pragma once

#include <memory>

#include "file_format.h"
#include "mesh_pieces.h"

namespace tetstream {

// Checks that every array holds what the counts need and tells the notes.
Input openPiecedMesh(MeshPieces mesh, const ReadOptions& options);

}  // namespace tetstream
