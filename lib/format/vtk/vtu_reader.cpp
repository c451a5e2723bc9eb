// Reads .vtu files (VTK XML unstructured grids) by range. Several pieces are read as one mesh, end
// to end.
#include <memory>

#include "pieced_mesh.h"
#include "vtk_format.h"
#include "vtu_file.h"
#include "vtu_pieces.h"

namespace tetstream {

Input openVtu(std::unique_ptr<ByteSource> bytes, const ReadOptions& options) {
  MeshPieces mesh;
  addVtuPieces(mesh, makeSeekable(std::move(bytes), options.temp_dir), options);
  return openPiecedMesh(std::move(mesh), options);
}

}  // namespace tetstream
