// layout/graph: the Laplacian of a graph, four vectors at a time. Depends on symmetric_eigen.h,
// base.
//
// (A x)_i = sum over the neighbours j of i of w_ij (x_i - x_j). Symmetric; if the graph is
// connected, A x = 0 for constant vectors only.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "memory.h"
#include "symmetric_eigen.h"

namespace tetstream {

typedef float Four __attribute__((vector_size(16)));  // element i of four vectors

// A connected graph in somebody's arrays. Neighbours of v: neighbour[first[v]] up to
// neighbour[first[v + 1] - 1].
struct GraphView {
  uint32_t vertices = 0;
  const uint32_t* first = nullptr;
  const uint32_t* neighbour = nullptr;
  const float* weight = nullptr;  // beside neighbour; null: all 1
  float weightAt(uint32_t entry) const { return weight ? weight[entry] : 1.0f; }
};

void applyLaplacian(const GraphView& graph, const Four* x, Four* product);

// The same graph on ever fewer vertices: pairs joined by heavy edges, and pairs of pairs, become
// one. With them a rough solution of A x = b takes a few times as long as A x (multigrid by
// aggregation). About 100 bytes a vertex of a mesh.
class LaplacianLevels {
 public:
  LaplacianLevels(const GraphView& finest, Account& account);

  size_t count() const { return levels_.size(); }
  const GraphView& graph(size_t level) const { return levels_[level]->graph; }  // 0: the finest
  // Of each vertex of the level: its place on the one after.
  const uint32_t* parents(size_t level) const { return levels_[level]->parent.data(); }
  // x of A x = b, roughly: linear in b, symmetric and positive definite.
  void solveRoughly(size_t level, const Four* b, Four* x);
  // On the coarsest level: the eigenvectors of the lowest eigenvalues above 0, as many of four as
  // there are, and zeros. Returns the eigenvalues.
  std::array<double, 4> lowest(Four* x) const;

 private:
  struct Level {
    explicit Level(Account& account);
    void invertDiagonal();
    GraphView graph;  // of the arrays here, but on the finest level
    Array<uint32_t> first, neighbour;
    Array<float> weight, inverse_diagonal;
    Array<uint32_t> parent;
    Array<Four> right, solution;  // scratch, not of the finest level
  };

  void addCoarser();
  std::unique_ptr<Level> join(const GraphView& fine, const Array<uint32_t>& parent,
                              uint32_t vertices);
  void prepareCoarsest();
  void solveCoarsest(const Four* b, Four* x) const;
  static void restrictRest(const Level& fine, const Four* b, const Four* x, Level& next);

  Account& account_;
  std::vector<std::unique_ptr<Level>> levels_;
  Eigen coarsest_;
};

}  // namespace tetstream
