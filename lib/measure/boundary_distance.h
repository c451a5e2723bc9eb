// measure: how far one boundary is from another. Depends on nearest_points.h, part_box.h.
#pragma once

#include <cmath>
#include <functional>
#include <limits>

#include "nearest_points.h"
#include "part_box.h"

namespace tetstream {

// No numbers where there is nothing to measure from.
struct DistanceFigures {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double largest = kNone;  // over the samples and all vertices of those triangles
  double place[3] = {kNone, kNone, kNone};
  double rms = kNone, mean = kNone;  // over the samples
  bool areThere() const { return !std::isnan(largest); }
};

// About `samples` points, uniform by area, of those triangles of a boundary whose centres lie in
// the part, which have that area.
struct SurfaceSampling {
  int64_t samples;
  uint64_t seed;
  double area;
  Box part;
};

struct DistanceBudget {
  Account& account;
  std::string temp_dir;
  size_t bytes;
  const Tasks* tasks;
};

// From `from` to the nearest points of all of `to`; infinite, nowhere, where that has none.
DistanceFigures boundaryDistance(SimplexRows& from, SimplexRows& to,
                                 const SurfaceSampling& sampling, const DistanceBudget& budget,
                                 const std::function<void(double)>& share);

}  // namespace tetstream
