#include "triangle.h"

#include <algorithm>
#include <cmath>

#include "vector3.h"

namespace tetstream {

double triangleArea(const double* corners) {
  double u[3], v[3], n[3];
  subtract(corners + 3, corners, u);
  subtract(corners + 6, corners, v);
  cross(u, v, n);
  return std::sqrt(dot(n, n)) / 2;
}

// To the segment from a to b; `share`: how far along it the nearest point lies.
static double squaredToSegment(const double a[3], const double b[3], const double place[3],
                               double& share) {
  double along[3], to[3];
  subtract(b, a, along);
  subtract(place, a, to);
  const double length = dot(along, along);
  share = length > 0 ? std::clamp(dot(to, along) / length, 0.0, 1.0) : 0;
  for (int k = 0; k < 3; ++k) to[k] -= share * along[k];
  return dot(to, to);
}

// Where the square of the sine between two sides is below this, the foot is rounding in part, and
// nothing else in a triangle that is nearly a line: it may seem inside though an edge is nearer.
constexpr double kThin = 1e-4;

// The foot of the perpendicular if it is inside; else, or where the triangle is thin and one is
// nearer, the best of the three edges.
double squaredDistance(const double* corners, const double place[3], double coordinates[3]) {
  double u[3], v[3], w[3];
  subtract(corners + 3, corners, u);
  subtract(corners + 6, corners, v);
  subtract(place, corners, w);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double d = uu * vv - uv * uv;
  double least = -1;
  if (d > 0) {
    const double s = (vv * wu - uv * wv) / d, t = (uu * wv - uv * wu) / d;
    if (s >= 0 && t >= 0 && s + t <= 1) {
      for (int k = 0; k < 3; ++k) w[k] -= s * u[k] + t * v[k];
      coordinates[0] = 1 - s - t;
      coordinates[1] = s;
      coordinates[2] = t;
      least = dot(w, w);
      if (d > kThin * uu * vv) return least;
    }
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    double share = 0;
    const double found = squaredToSegment(corners + 3 * i, corners + 3 * j, place, share);
    if (least >= 0 && found >= least) continue;
    least = found;
    coordinates[0] = coordinates[1] = coordinates[2] = 0;
    coordinates[i] = 1 - share;
    coordinates[j] = share;
  }
  return least;
}

}  // namespace tetstream
