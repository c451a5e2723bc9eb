#include "thinness.h"

#include <algorithm>
#include <cmath>

#include "processor.h"
#include "thinness.inl"
#include "thinness_v3.h"
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

// e: from its first corner the cell's edges; n: of the face opposite each corner twice the area as
// a vector, outwards.
double thinness(const double p[4][3]) {
  double e[3][3], n[4][3], n2[4];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) e[k][i] = p[k + 1][i] - p[0][i];
  const double sum = dot(e[0], e[0]) + dot(e[1], e[1]) + dot(e[2], e[2]);
  const bool fits = sum > kLeastThinSum && sum < kLargestThinSum;
  if (!fits) {
    const double unit = 1 / largestDifference(p[0], p[1], p[2], p[3]);
    for (auto& edge : e)
      for (double& x : edge) x *= unit;
  }
  cross(e[2], e[1], n[1]);
  cross(e[0], e[2], n[2]);
  cross(e[1], e[0], n[3]);
  for (int i = 0; i < 3; ++i) {
    e[1][i] -= e[0][i];
    e[2][i] -= e[0][i];
  }
  cross(e[1], e[2], n[0]);
  const double six = -dot(e[0], n[1]);
  if (!(fits && six > 0 && six * six > kSureVolume * (sum * sum * sum)) &&
      orientation(p[0], p[1], p[2], p[3]) <= 0)
    return kTurned;
  for (int k = 0; k < 4; ++k) n2[k] = dot(n[k], n[k]);
  double worst = -1;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < k; ++l) {
      const double c = dot(n[k], n[l]), size = n2[k] * n2[l];
      if (!(size > 0)) return 1;
      worst = std::max(worst, (c < 0 ? c : -c) * c / size);
    }
  return worst;
}

template <class S>
void thinnessOfFour(const S* values, int stride, const uint32_t (*corners)[4], double* out) {
#ifdef TETSTREAM_V3_KERNELS
  static const bool has_v3 = processorHasV3();
  if (has_v3) return v3::thinnessOfFour(values, stride, corners, out);
#endif
  thinnessOfFourOf(values, stride, corners, out);
}

template void thinnessOfFour(const float*, int, const uint32_t (*)[4], double*);
template void thinnessOfFour(const double*, int, const uint32_t (*)[4], double*);

}  // namespace tetstream
