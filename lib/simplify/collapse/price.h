// simplify/collapse: what an edge costs besides its error: a sweep takes it at the bound of its
// price. Depends on nothing.
#pragma once

#include <algorithm>
#include <cstddef>

namespace tetstream {

// An edge whose collapse makes more cells thin than it should is taken at this times its error, and
// for cells below the smaller dear angle at the highest at most.
constexpr float kThinPrice = 2, kHighestPrice = 64;

// Where shapes come first, and yet the floor is a low one: how much error a cell's shape is worth.
// At 16 blades had 1.1 times the error and 0.95 times as many thin cells, at 64 1.5 and 0.8 times.
constexpr float kSolverPrice = 8;

inline float thinPrice(bool shapes_first) {
  return shapes_first ? kSolverPrice : kThinPrice;
}

// A place that keeps volumes and has more than this times the error of the best one has its own
// error as its price: where curves and sheets are tightly curved, the step to it may be large.
constexpr float kDearGrowth = 1.5f;

// What is merged with a vertex of a curve that stays where it is changes the volumes beside the
// curve's sheets, unless they are plane. Small as that is, it mostly has the same sign all along
// the curve, and nothing makes up for it: it costs that many times the error.
constexpr float kIntoCurve = 4;

// And no collapse may change a region by a larger share of the volume that it has in all: where few
// cells are left, and whatever costs less is refused, some would take a tenth of it at once.
constexpr double kOfARegion = 0.003;

// In the error of the best place. Where that is none, still a number.
template <class S>
float growthPrice(S best, S there) {
  if (!(there > kDearGrowth * best)) return 1;
  constexpr double kMost = 1e30;
  const double growth = static_cast<double>(there) / static_cast<double>(best);
  return static_cast<float>(std::clamp(growth, double{kThinPrice}, kMost));
}

// Of meshes with many cells below the smaller dear angle. With an error of one part in kFlatParts
// of the bound an edge may be collapsed that leaves as large a share of them; each cell that it
// leaves more of them, or fewer, counts as kFlatCost of the bound. Larger ones leave fewer such
// cells, at a larger error and for more time: an edge is tried again at the bound of its price.
constexpr double kFlatParts = 2, kFlatCost = 0.2;

// `before` and `after`: such cells among all of both ends, of which `dying` go and `left` stay.
inline float flatPrice(size_t before, size_t after, size_t dying, size_t left) {
  const auto stay = static_cast<double>(left);
  const double share_left = stay / (stay + static_cast<double>(dying));
  const double more = static_cast<double>(after) - static_cast<double>(before) * share_left;
  const double part = 1 / kFlatParts - kFlatCost * more;
  return static_cast<float>(1 / std::clamp(part, 1.0 / kHighestPrice, 1.0));
}

}  // namespace tetstream
