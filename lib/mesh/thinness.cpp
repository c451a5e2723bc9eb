#include "thinness.h"

#include <algorithm>
#include <cmath>

#include "orient.h"
#include "topology.h"
#include "vector3.h"

namespace tetstream {

double thinnessOfAngle(double degrees) {
  const double cosine = std::cos(degrees * std::acos(-1.0) / 180);
  return cosine * cosine;
}

double regularity(const double p[4][3], double scale) {
  double e[3][3], sum = 0;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) e[k][i] = (p[k + 1][i] - p[0][i]) * scale;
    const double a = e[0][i], b = e[1][i], c = e[2][i];
    sum += a * a + b * b + c * c + (b - a) * (b - a) + (c - a) * (c - a) + (c - b) * (c - b);
  }
  const double volume = determinant(e[0], e[1], e[2]);
  return 432 * (volume * volume) / (sum * sum * sum);
}

double thinness(const double p[4][3]) {
  if (orientation(p[0], p[1], p[2], p[3]) <= 0) return kTurned;
  const double unit = 1 / largestDifference(p[0], p[1], p[2], p[3]);
  double e[4][3], n[4][3], n2[4];
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) e[k][i] = (p[k][i] - p[0][i]) * unit;
  for (int k = 0; k < 4; ++k) {  // twice the area of the face opposite k, as a vector
    const double *a = e[kOpposite[k][0]], *b = e[kOpposite[k][1]], *c = e[kOpposite[k][2]];
    for (int i = 0; i < 3; ++i) {
      const int y = (i + 1) % 3, z = (i + 2) % 3;
      n[k][i] = (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
    }
    n2[k] = n[k][0] * n[k][0] + n[k][1] * n[k][1] + n[k][2] * n[k][2];
  }
  double worst = -1;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < k; ++l) {
      const double c = n[k][0] * n[l][0] + n[k][1] * n[l][1] + n[k][2] * n[l][2];
      const double size = n2[k] * n2[l];
      if (!(size > 0)) return 1;
      worst = std::max(worst, (c < 0 ? c : -c) * c / size);
    }
  return worst;
}

}  // namespace tetstream
