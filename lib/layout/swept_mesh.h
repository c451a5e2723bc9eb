// layout: a mesh that is too large for its graph, swept into temporary files and ranked breadth
// first on the way. Depends on breadth_first_pieces.h, ordered_source.h, spooled_mesh.h.
#pragma once

#include "breadth_first_pieces.h"
#include "ordered_source.h"
#include "spooled_mesh.h"

namespace tetstream {

class SweptMesh {
 public:
  SweptMesh(IndexedSource& source, const OrderOptions& options, size_t memory_bytes,
            Account& account, const Tell& tell);

  IndexedSource& mesh() { return *mesh_; }
  int64_t unusedVertices() const { return unused_; }
  uint64_t diskBytes() const { return disk_; }
  // For each point of the mesh once, in order.
  VertexKey key();

 private:
  PiecewiseBreadthFirst ranks_;
  std::unique_ptr<SpooledMesh> mesh_;
  int64_t unused_ = 0;
  uint64_t disk_ = 0;
};

}  // namespace tetstream
