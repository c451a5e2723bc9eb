// format: the pieces of .vtu files as those of a mesh. Depends on vtu_file.h, mesh_pieces.h.
#pragma once

#include <memory>

#include "mesh_pieces.h"
#include "vtu_file.h"

namespace tetstream {

// Adds the pieces of one file, which stays open; the mesh takes its name.
void addVtuPieces(MeshPieces& mesh, std::unique_ptr<ByteSource> bytes);

}  // namespace tetstream
