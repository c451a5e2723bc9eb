// format/vtk: the pieces of .vtu files as those of a mesh. Depends on file_pool.h,
// file_format.h, mesh_pieces.h, vtu_file.h.
#pragma once

#include <memory>

#include "file_format.h"
#include "file_pool.h"
#include "mesh_pieces.h"
#include "vtu_file.h"

namespace tetstream {

// Adds the pieces of one file, or of its time step that the options want; it stays open, and the
// mesh takes its name. The options' threads help the thread that calls when it reads.
void addVtuPieces(MeshPieces& mesh, std::unique_ptr<ByteSource> bytes, const ReadOptions& options);

// Adds those of the files that a .pvtu file names.
void addPvtuPieces(MeshPieces& mesh, FilePool& pool, ByteSource& bytes, const ReadOptions& options);

}  // namespace tetstream
