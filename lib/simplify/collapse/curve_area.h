// simplify/collapse: places that keep the area which a curve bounds. Depends on mesh.
#pragma once

#include "vector3.h"

namespace tetstream {

// Two vertices u and v of a curve, with a before and b behind them, become one at x. What the
// polygons a u v b and a x b span, as vectors,
//   2 A = (u - a) x (v - a) + (v - a) x d   and   2 A' = (x - a) x d,   d = b - a,
// is the same across d where (x - a) = (d x 2 A) / d^2 + t d: x moves to the nearest such place. So
// the faces on either side of a plane curve neither grow nor shrink, where quadrics alone let round
// ones shrink. False, and x stays, if a and b coincide.
inline bool keepArea(const double a[3], const double u[3], const double v[3], const double b[3],
                     double x[3]) {
  double to_u[3], to_v[3], to_x[3], d[3], fan[3], rest[3], off[3];
  for (int i = 0; i < 3; ++i) {
    to_u[i] = u[i] - a[i];
    to_v[i] = v[i] - a[i];
    to_x[i] = x[i] - a[i];
    d[i] = b[i] - a[i];
  }
  const double square = dot(d, d);
  if (!(square > 0)) return false;
  cross(to_u, to_v, fan);
  cross(to_v, d, rest);
  for (int i = 0; i < 3; ++i) fan[i] += rest[i];
  cross(d, fan, off);
  const double t = dot(to_x, d) / square;
  for (int i = 0; i < 3; ++i) x[i] = a[i] + off[i] / square + t * d[i];
  return true;
}

}  // namespace tetstream
