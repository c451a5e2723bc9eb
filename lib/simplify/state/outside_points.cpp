#include "outside_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cell_faces.h"
#include "triangle.h"

namespace tetstream {

// Cells are looked at up to so far away, of their mean extent, and where none is that near up to
// twice as far, some times.
constexpr double kNear = 0.25;
constexpr int kDoublings = 10;

static void boxOf(const double corners[4][3], double low[3], double high[3]) {
  for (int i = 0; i < 3; ++i) {
    low[i] = std::min({corners[0][i], corners[1][i], corners[2][i], corners[3][i]});
    high[i] = std::max({corners[0][i], corners[1][i], corners[2][i], corners[3][i]});
  }
}

// Of a cell, the nearest of its four faces' points: the distance, and the weights of its corners.
static double nearestOnFaces(const double corners[4][3], const double place[3], double weights[4]) {
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < 4; ++j) {
    double face[3][3], at[3];
    for (int k = 0; k < 3; ++k) std::copy_n(corners[kOpposite[j][k]], 3, face[k]);
    const double square = squaredDistance(face[0], place, at);
    if (!(square < least)) continue;
    least = square;
    weights[j] = 0;
    for (int k = 0; k < 3; ++k) weights[kOpposite[j][k]] = at[k];
  }
  return least;
}

template <class S>
void OutsidePoints<S>::add(uint32_t point, const double place[3]) {
  points_.push_back(
      {{place[0], place[1], place[2]}, std::numeric_limits<double>::infinity(), point, kNone});
}

// Those that may have a nearer cell than was found so far first, along the axis on which they
// extend farthest.
template <class S>
void OutsidePoints<S>::sortAlongLongest(double looked_at) {
  const auto end = std::partition(points_.begin(), points_.end(), [looked_at](const Point& p) {
    return !(p.square <= looked_at * looked_at);
  });
  left_ = static_cast<size_t>(end - points_.begin());
  double longest = -1;
  for (size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax_element(
        points_.begin(), end,
        [i](const Point& a, const Point& b) { return a.place[i] < b.place[i]; });
    const double extent = left_ > 0 ? high->place[i] - low->place[i] : 0;
    if (!(extent > longest)) continue;
    longest = extent;
    axis_ = i;
  }
  std::sort(points_.begin(), end, [this](const Point& a, const Point& b) {
    return a.place[axis_] != b.place[axis_] ? a.place[axis_] < b.place[axis_] : a.point < b.point;
  });
}

// Points no farther than that from the cell's box.
template <class S>
void OutsidePoints<S>::lookFrom(uint32_t cell, double beyond) {
  double corners[4][3], low[3], high[3];
  cornersInUnits(core_, cell, corners);
  boxOf(corners, low, high);
  const auto toBox = [&](const Point& point) {
    double square = 0;
    for (size_t i = 0; i < 3; ++i) {
      const double off = std::max({low[i] - point.place[i], point.place[i] - high[i], 0.0});
      square += off * off;
    }
    return square;
  };
  const auto end = points_.begin() + static_cast<std::ptrdiff_t>(left_);
  auto p = std::partition_point(points_.begin(), end, [&](const Point& point) {
    return point.place[axis_] < low[axis_] - beyond;
  });
  for (; p != end && p->place[axis_] <= high[axis_] + beyond; ++p) {
    if (!(toBox(*p) < std::min(p->square, beyond * beyond))) continue;
    double weights[4];
    const double square = nearestOnFaces(corners, p->place, weights);
    if (!(square < p->square)) continue;
    p->square = square;
    p->cell = cell;
  }
}

// Of the cells' longest sides along an axis: the geometric mean, as most are small beside some.
template <class S>
double OutsidePoints<S>::meanExtent() const {
  const Topology& mesh = core_.window.mesh;
  double sum = 0;
  for (uint32_t c = 0; c < mesh.cellEnd(); ++c) {
    if (!mesh.isLive(c)) continue;
    double corners[4][3], low[3], high[3];
    cornersInUnits(core_, c, corners);
    boxOf(corners, low, high);
    const double longest = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    if (longest > 0) sum += std::log(longest);
  }
  return std::exp(sum / std::max<double>(mesh.liveCells(), 1));
}

template <class S>
void OutsidePoints<S>::search() {
  if (points_.empty()) return;
  const Topology& mesh = core_.window.mesh;
  double far = kNear * meanExtent();
  sortAlongLongest(0);
  for (int k = 0; k < kDoublings && left_ > 0; ++k, far *= 2) {
    for (uint32_t c = 0; c < mesh.cellEnd(); ++c)
      if (mesh.isLive(c)) lookFrom(c, far);
    sortAlongLongest(far);
  }
}

template <class S>
typename OutsidePoints<S>::Found OutsidePoints<S>::foundAt(const Point& point) const {
  double corners[4][3];
  cornersInUnits(core_, point.cell, corners);
  Found found = {point.point, point.cell, {}};
  nearestOnFaces(corners, point.place, found.weights);
  return found;
}

template class OutsidePoints<float>;
template class OutsidePoints<double>;

}  // namespace tetstream
