#include "crossing_faces.h"

#include <algorithm>

namespace tetstream {

void PlacedFace::bound() {
  for (int i = 0; i < 3; ++i) {
    low[i] = std::min({at[0][i], at[1][i], at[2][i]});
    high[i] = std::max({at[0][i], at[1][i], at[2][i]});
  }
}

// Six times the volume of a cell.
static double volumeOf(const double o[3], const double a[3], const double b[3], const double c[3]) {
  double d[3][3];
  for (int i = 0; i < 3; ++i) {
    d[0][i] = a[i] - o[i];
    d[1][i] = b[i] - o[i];
    d[2][i] = c[i] - o[i];
  }
  return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) +
         d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
         d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}

// The k-th edge of one through the other.
static bool passes(const PlacedFace& from, int k, const PlacedFace& through) {
  const int next = (k + 1) % 3;
  if (through.has(from.corner[k]) || through.has(from.corner[next])) return false;
  const double *const a = from.at[k], *const b = from.at[next];
  const auto& t = through.at;
  const double first = volumeOf(t[0], t[1], t[2], a), last = volumeOf(t[0], t[1], t[2], b);
  if (!(first > 0 ? last < 0 : first < 0 && last > 0)) return false;
  const bool side = volumeOf(a, b, t[0], t[1]) > 0;
  return (volumeOf(a, b, t[1], t[2]) > 0) == side && (volumeOf(a, b, t[2], t[0]) > 0) == side;
}

bool cross(const PlacedFace& a, const PlacedFace& b) {
  for (int i = 0; i < 3; ++i)
    if (a.low[i] > b.high[i] || b.low[i] > a.high[i]) return false;
  for (int k = 0; k < 3; ++k)
    if (passes(a, k, b) || passes(b, k, a)) return true;
  return false;
}

}  // namespace tetstream
