// mesh: the side of a plane on which a point lies, exactly. Depends on nothing.
#pragma once

#include <cstddef>

namespace tetstream {

// Sign of det(b - a, c - a, d - a), six times the signed volume of the cell (a, b, c, d), decided
// exactly for finite doubles (along each axis: not more than 2^300 apart in size, or equal, or
// zero): floating-point filter first, expansions where it cannot tell (Shewchuk, Adaptive precision
// floating-point arithmetic, 1997).
int orientation(const double a[3], const double b[3], const double c[3], const double d[3]);

// Eight triangles and a point at once. xyz[3 * k + i][lane]: coordinate i of corner k.
constexpr int kLanes = 8;
struct TriangleLanes {
  alignas(64) double xyz[9][kLanes];
};

// Sign of det(t0 - x, t1 - x, t2 - x) in each lane: 1, -1, or 0 where rounding could have changed
// it; the caller then asks orientation(). `shape` is det / (sum of the six squared edges)^(3/2),
// relative to the regular cell's: 1 for that, 0 for a flat one; its 2/3rd power is known as the
// mean ratio. Lanes from `count` on are not looked at: sign 1, shape 1.
void orientationLanes(const double x[3], const TriangleLanes& triangles, int count,
                      signed char sign[kLanes], double shape[kLanes]);

}  // namespace tetstream
