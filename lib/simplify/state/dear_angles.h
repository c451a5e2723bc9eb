// simplify/state: the angles that cells are dear below. Depends on core.h, mesh.
#pragma once

#include <algorithm>
#include <vector>

#include "core.h"
#include "thinness.h"

namespace tetstream {

// Where shapes come first, cells are flipped whose smallest angle is below this many floors, or
// below the first dear angle, where the input made the floor a low one. At 2 it takes twice the
// time.
constexpr double kPoor = 1.5;

// Collapses that make more cells thinner than these have their price, and cells are flipped that
// are below the last of them, or suit solvers too little.
template <class S>
void setDear(Core<S>& core, const std::vector<ThinAngle>& dear) {
  core.dear = dear;
  double poor = kPoor * core.thin.degrees;
  if (!core.dear.empty())
    poor =
        core.shapesFirst() ? std::max(poor, core.dear.front().degrees) : core.dear.back().degrees;
  core.poor = thinnessOfAngle(std::min(poor, 90.0));
}

// Of a mesh held whole, when one in so many of its cells is left. The floor bars the way then: with
// a price from an eighth on meshes at 0.02 and 0.01 had 0.88 and 0.73 times the RMS error, and 0.77
// and 0.68 times the distance of the boundary, in 1.0 to 1.05 times the time; from the first cell
// on as much, in 1.2 times. From a tenth on ratios of 0.1 and more stay as they are.
constexpr int64_t kFewLeft = 10;

// Where memory is tight no window holds the whole, and each of them runs into the floor: a ball
// with shells at 0.02 in 12 MB had 0.47 times the RMS error and 0.43 times the distance with a
// price from the first cell on, chaste's flows 0.70 to 0.86, a block with 27 balls 0.64 and 0.33,
// in as much time; some reached targets that they missed. (Long streams with wide windows have 0.97
// to 1.00, in 1.2 times the time.)
template <class S>
bool leavesFewInParts(const Core<S>& core) {
  return core.is_tight && core.options.shape == Shape::kField && kFewLeft * core.target_ratio < 1;
}

// Whether cells have become dear by it, or because passes are stuck before that: what is left costs
// much more than what the floor bars the way to. Where a field jumps meshes had 0.7 and 0.96 times
// the RMS error at 0.1 and 0.05 by that, a bow shock 0.5 and 0.95, a kink 0.8 and 0.94, in as much
// time.
template <class S>
bool makeDearWhereFewAreLeft(Core<S>& core, bool are_stuck) {
  if (!core.dear.empty() || core.dear_when_few.empty() || !core.holdsAll()) return false;
  if (!are_stuck && kFewLeft * core.window.liveCells() >= core.stream_cells) return false;
  setDear(core, core.dear_when_few);
  return true;
}

}  // namespace tetstream
