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
