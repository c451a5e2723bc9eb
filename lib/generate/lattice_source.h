// generate: a lattice of cubes as a stream of cells. Depends on placement.h, mixing_layer.h,
// cube_split.h and stream.
#pragma once

#include <cstdint>

#include "batch.h"
#include "cube_split.h"
#include "lattice.h"
#include "mixing_layer.h"
#include "placement.h"
#include "source.h"

namespace tetstream {

// What makes one mesh of lattice cubes differ from another.
struct LatticeMesh {
  Lattice lattice;
  bool octants = false;  // diagonals point away from the centre; else all are parallel
  void (*place)(const Lattice&, uint64_t seed, const VertexRun&, Positions*) = nullptr;
  float layer_origin[3] = {0, 0, 0};  // where the mixing layer's (0, 0, 0) is in the mesh
  bool with_stress = false;           // a third field, of six components
};

// Memory does not depend on the size of the mesh.
class LatticeSource : public Source {
 public:
  // `schema` tells the front and the box of positions; counts, fields and their box are added.
  LatticeSource(const LatticeMesh& mesh, uint64_t seed, const Schema& schema);
  const Schema& schema() const override { return schema_; }
  bool next(BatchView& batch) override;

 private:
  void addRun(int64_t cubes);
  void addLines(int64_t first_a, int64_t last_a);
  void addVertices(const VertexRun& run, size_t row, size_t stride);
  void addFields(const Positions& at, int count, size_t row, size_t stride);
  void addCubes(int64_t cubes);
  const CubeSplit& splitAt(int64_t i) const;

  LatticeMesh mesh_;
  uint64_t seed_;
  MixingLayer layer_;
  CubeSplit splits_[8];  // by the diagonal's start
  Schema schema_;
  Batch batch_;
  int64_t i_ = 0, j_ = 0, k_ = 0;  // the next cube
  uint64_t vertices_given_ = 0;
};

}  // namespace tetstream
