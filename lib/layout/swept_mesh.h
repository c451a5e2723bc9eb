// layout: a mesh that is too large for its graph, laid out by place into temporary files, and its
// order by pieces of that. Depends on breadth_first_pieces.h, spectral_clusters.h,
// ordered_source.h, spooled_mesh.h.
#pragma once

#include <optional>

#include "breadth_first_pieces.h"
#include "ordered_source.h"
#include "spectral_clusters.h"
#include "spooled_mesh.h"

namespace tetstream {

class SweptMesh {
 public:
  // `order`: breadth-first, which is found in a sweep, or spectral, along Hilbert's curve.
  SweptMesh(IndexedSource& source, Order order, const OrderOptions& options, size_t memory_bytes,
            Account& account, const Tell& tell);

  IndexedSource& mesh() { return *mesh_; }
  int64_t unusedVertices() const { return unused_; }
  uint64_t diskBytes() const { return disk_; }
  // For each point of the mesh once, in order.
  VertexKey key();

 private:
  void rank(Source& swept, size_t memory_bytes, Account& account, const std::string& temp_dir,
            const Tell& tell);

  std::optional<PiecewiseBreadthFirst> ranks_;
  std::optional<SpectralClusters> clusters_;
  std::unique_ptr<SpooledMesh> mesh_;
  int64_t unused_ = 0;
  uint64_t disk_ = 0;
};

}  // namespace tetstream
