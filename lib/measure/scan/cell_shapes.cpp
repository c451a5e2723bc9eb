#include "cell_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetstream {

namespace {

constexpr double kDegrees = 57.29577951308232;

struct Vector {
  double x, y, z;
  Vector operator-(Vector o) const { return {x - o.x, y - o.y, z - o.z}; }
  double dot(Vector o) const { return x * o.x + y * o.y + z * o.z; }
  Vector cross(Vector o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
  double length() const { return std::sqrt(dot(*this)); }
};

// With a, b, c the products of opposite edges' lengths, the circumradius is
// sqrt((a + b + c)(a + b - c)(a - b + c)(b + c - a)) / 24 V, the inradius 3 V / area.
double aspectOf(const Vector p[4], double doubled_area, double volume) {
  const auto length = [&](int i, int j) { return (p[i] - p[j]).length(); };
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
  Vector p[4], normal[4];
  for (int i = 0; i < 4; ++i) p[i] = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
  static constexpr int kFaces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  double area[4];
  for (int i = 0; i < 4; ++i) {
    const Vector a = p[kFaces[i][0]];
    normal[i] = (p[kFaces[i][1]] - a).cross(p[kFaces[i][2]] - a);
    area[i] = normal[i].length();
  }
  double least = -1, largest = 1;  // cosines
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      // A face without area has no direction: its angles count as none.
      const double cosine = -normal[i].dot(normal[j]) / (area[i] * area[j]);
      least = std::max(least, std::isnan(cosine) ? 1.0 : cosine);
      largest = std::min(largest, std::isnan(cosine) ? 1.0 : cosine);
    }
  const double angle = kDegrees * std::acos(std::clamp(least, -1.0, 1.0));
  const double widest = kDegrees * std::acos(std::clamp(largest, -1.0, 1.0));
  last_volume_ = std::fabs((p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]))) / 6;
  const double aspect = aspectOf(p, area[0] + area[1] + area[2] + area[3], last_volume_);
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
