// layout: the spectral order of a mesh that does not fit the memory, through clusters of its
// vertices. Depends on spectral.h, ranked_vertices.h.
#pragma once

#include "ranked_vertices.h"

namespace tetstream {

// Vertices that follow each other along Hilbert's curve make a cluster. The lowest eigenvectors of
// the clusters' graph are found in core (spectral.h); their values are continued to the vertices
// linearly in space, with the gradient that fits the neighbours of a cluster best.
class SpectralClusters {
 public:
  // `mesh`: its points, all of them used, come along the curve. Reads points and cells once.
  SpectralClusters(IndexedSource& mesh, const RankedVertices::Budget& budget, const Tell& tell);

  double valueAt(uint64_t point, const double place[3]) const;
  uint64_t diskBytes() const { return disk_; }

 private:
  struct Cluster {
    double centre[3], gradient[3];
    double value;
  };

  void findCentres(const Tell& tell);
  void findValues(const RankedVertices::Budget& budget, const Tell& tell);
  void fitGradients(const Array<uint32_t>& corners);

  IndexedSource& mesh_;
  uint64_t size_;  // vertices of a cluster
  std::vector<Cluster> clusters_;
  uint64_t disk_ = 0;
};

}  // namespace tetstream
