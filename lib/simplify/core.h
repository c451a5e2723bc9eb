// simplify: the state that the steps of a run share. Depends on mesh, plan.h, options.h.
#pragma once

#include <cmath>

#include "front.h"
#include "kernels.h"
#include "options.h"
#include "plan.h"
#include "window.h"

namespace tetstream {

// Vertex flags beside those of topology.h: the boundary round a final vertex is known, and its
// quadric complete.
constexpr uint8_t kResolved = 32;
// Locked by the stream itself, which the output says again.
constexpr uint8_t kCallerLocked = 64;

// Vertices that never move, by reason: what a missed target is explained with.
struct LockedVertices {
  int64_t interfaces = 0, non_manifold = 0, bad_cells = 0, by_caller = 0;
};

constexpr size_t kCellsPerVertex = 4;  // 5.5 inside a mesh, less towards a boundary
constexpr size_t kCellBytes = 37;      // four corners, their links, flags, place in a tile
constexpr size_t kVertexBytes = 21;    // corner, flags, rank, new slot, uses

template <class S>
struct Core {
  Core(const Plan& the_plan, const SimplifyOptions& the_options, Account& account, size_t cells,
       size_t vertices, uint64_t span)
      : plan(the_plan),
        options(the_options),
        kernels(quadricKernels<S>(the_plan.dimension)),
        window(account, shapeOf(the_plan), cells, vertices),
        front(account, span),
        scale(static_cast<size_t>(the_plan.dimension), S(1)),
        inverse_scale(scale) {}

  static WindowShape shapeOf(const Plan& plan) {
    return {plan.values, quadricSize(plan.dimension), plan.picks, plan.cell_means, plan.cell_picks};
  }

  // What a window of one cell takes, with its share of vertices and the steps' own arrays.
  static size_t bytesPerCell(const Plan& plan) {
    const WindowShape shape = shapeOf(plan);
    const size_t vertex = sizeof(S) * static_cast<size_t>(shape.values + shape.quadric) +
                          sizeof(int64_t) * static_cast<size_t>(shape.picks) + kVertexBytes;
    const size_t data = sizeof(double) * static_cast<size_t>(shape.cell_means + 1) +
                        sizeof(int64_t) * static_cast<size_t>(shape.cell_picks);
    return kCellBytes + (shape.cell_means + shape.cell_picks ? data : 0) + vertex / kCellsPerVertex;
  }

  const Plan& plan;
  const SimplifyOptions& options;
  const QuadricKernels<S>& kernels;
  Window<S> window;
  Front front;
  std::vector<S> scale, inverse_scale;  // per dimension: normalised = scale * user's units
  double error_unit = 1;                // times a quadric error: the report's unit
  Report report;
  LockedVertices locked;
};

template <class S>
inline void positionOf(const Window<S>& window, uint32_t v, double out[3]) {
  const S* x = window.values(v);
  for (int i = 0; i < 3; ++i) out[i] = static_cast<double>(x[i]);
}

}  // namespace tetstream
