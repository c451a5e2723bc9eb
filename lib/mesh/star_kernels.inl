// mesh: the body of orientationLanes, compiled once per instruction set. Plain arithmetic in a
// fixed order, no contraction: the same answers from every build.
#include "orient.h"

namespace tetstream {
namespace {

// det = a . (b x c) of the differences; its rounding error is at most (7 + 56 u) u times the sum
// of the absolute products, u = 2^-53, the rounding of the differences included (Shewchuk 1997,
// section 4.3). The factor is raised a little for the rounding of the bound itself.
constexpr double kErrorBound = 8.0 / 9007199254740992.0;

// (6 squared edges of 1)^(3/2) / (6 V of the regular cell, 1 / sqrt 2)
constexpr double kRegular = 20.784609690826528;

// Products that underflow are outside that bound. Where the bound is above kLeastBound and no
// coordinate difference above kLargestDifference, they change less than what it was raised by.
constexpr double kLeastBound = 1e-250, kLargestDifference = 1e60;

inline double squares(double a, double b, double c) {
  return a * a + b * b + c * c;
}

inline double magnitude(double v) {
  return v < 0 ? -v : v;
}

inline void lanes(const double x[3], const TriangleLanes& t, signed char sign[kLanes],
                  double shape[kLanes]) {
  double det[kLanes], bound[kLanes], size[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    const double ax = t.xyz[0][k] - x[0], ay = t.xyz[1][k] - x[1], az = t.xyz[2][k] - x[2];
    const double bx = t.xyz[3][k] - x[0], by = t.xyz[4][k] - x[1], bz = t.xyz[5][k] - x[2];
    const double cx = t.xyz[6][k] - x[0], cy = t.xyz[7][k] - x[1], cz = t.xyz[8][k] - x[2];
    const double p1 = by * cz, p2 = bz * cy, p3 = bz * cx, p4 = bx * cz, p5 = bx * cy, p6 = by * cx;
    det[k] = ax * (p1 - p2) + ay * (p3 - p4) + az * (p5 - p6);
    bound[k] = kErrorBound * (magnitude(ax) * (magnitude(p1) + magnitude(p2)) +
                              magnitude(ay) * (magnitude(p3) + magnitude(p4)) +
                              magnitude(az) * (magnitude(p5) + magnitude(p6)));
    size[k] = magnitude(ax) + magnitude(ay) + magnitude(az);
    const double sum = squares(ax, ay, az) + squares(bx, by, bz) + squares(cx, cy, cz) +
                       squares(ax - bx, ay - by, az - bz) + squares(bx - cx, by - cy, bz - cz) +
                       squares(cx - ax, cy - ay, cz - az);
    shape[k] = kRegular * det[k] / (sum * __builtin_sqrt(sum));
  }
  for (int k = 0; k < kLanes; ++k) {
    const bool sure = bound[k] > kLeastBound && size[k] < kLargestDifference;
    sign[k] = static_cast<signed char>(sure * ((det[k] > bound[k]) - (det[k] < -bound[k])));
  }
}

}  // namespace
}  // namespace tetstream
