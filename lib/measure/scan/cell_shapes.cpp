#include "cell_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cell_faces.h"
#include "vector3.h"

namespace tetstream {

namespace {

constexpr double kDegrees = 57.29577951308232;

double lengthOf(const double a[3]) {
  return std::sqrt(dot(a, a));
}

// With a, b, c the products of opposite edges' lengths, the circumradius is
// sqrt((a + b + c)(a + b - c)(a - b + c)(b + c - a)) / 24 V, the inradius 3 V / area.
double aspectOf(const double* corners, double doubled_area, double volume) {
  const auto length = [&](int i, int j) {
    double edge[3];
    subtract(corners + 3 * i, corners + 3 * j, edge);
    return lengthOf(edge);
  };
  const double a = length(0, 1) * length(2, 3), b = length(0, 2) * length(1, 3),
               c = length(0, 3) * length(1, 2);
  const double product = (a + b + c) * (a + b - c) * (a - b + c) * (b + c - a);
  const double radius = std::sqrt(std::max(product, 0.0)) / (24 * volume);
  const double inner = 3 * volume / (doubled_area / 2);
  const double aspect = radius / (3 * inner);
  return volume > 0 && !std::isnan(aspect) ? aspect : std::numeric_limits<double>::infinity();
}

}  // namespace

void CellShapes::add(const double* corners, int side) {
  double normal[4][3], area[4];  // twice the area
  for (int i = 0; i < 4; ++i) {
    const double* const a = corners + 3 * kOpposite[i][0];
    double u[3], v[3];
    subtract(corners + 3 * kOpposite[i][1], a, u);
    subtract(corners + 3 * kOpposite[i][2], a, v);
    cross(u, v, normal[i]);
    area[i] = lengthOf(normal[i]);
  }
  double least = -1, largest = 1;  // cosines
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      // A face without area has no direction: its angles count as none.
      const double cosine = -dot(normal[i], normal[j]) / (area[i] * area[j]);
      least = std::max(least, std::isnan(cosine) ? 1.0 : cosine);
      largest = std::min(largest, std::isnan(cosine) ? 1.0 : cosine);
    }
  const double angle = kDegrees * std::acos(std::clamp(least, -1.0, 1.0));
  const double widest = kDegrees * std::acos(std::clamp(largest, -1.0, 1.0));
  last_volume_ = std::fabs(sixVolume(corners, corners + 3, corners + 6, corners + 9)) / 6;
  const double aspect = aspectOf(corners, area[0] + area[1] + area[2] + area[3], last_volume_);
  sums_.least_angle = cells_ == 0 ? angle : std::min(sums_.least_angle, angle);
  sums_.largest_angle = std::max(sums_.largest_angle, widest);
  sums_.largest_aspect = std::max(sums_.largest_aspect, aspect);
  sums_.mean_least_angle += angle;
  below_[0] += angle < 1;
  below_[1] += angle < 5;
  below_[2] += angle < 10;
  sums_.volume += last_volume_;
  sums_.positive += side > 0;
  sums_.negative += side < 0;
  sums_.flat += side == 0;
  const double step = aspect < 1e9 ? std::log(std::max(aspect, 1.0)) / std::log(1.01) : kSteps;
  ++aspects_[std::min(static_cast<int>(step), kSteps - 1)];
  ++cells_;
}

// The middle of the step in which that share of the cells is reached.
double CellShapes::percentile(double share) const {
  int64_t left = static_cast<int64_t>(share * static_cast<double>(cells_));
  int step = 0;
  while (step < kSteps - 1 && left >= aspects_[step]) left -= aspects_[step++];
  if (step == kSteps - 1) return sums_.largest_aspect;
  return std::min(std::pow(1.01, step + 0.5), sums_.largest_aspect);
}

ShapeFigures CellShapes::figures() const {
  ShapeFigures out = sums_;
  if (cells_ == 0) return out;
  const auto n = static_cast<double>(cells_);
  out.mean_least_angle /= n;
  out.below_1 = static_cast<double>(below_[0]) / n;
  out.below_5 = static_cast<double>(below_[1]) / n;
  out.below_10 = static_cast<double>(below_[2]) / n;
  out.median_aspect = percentile(0.5);
  out.p99_aspect = percentile(0.99);
  return out;
}

}  // namespace tetstream
