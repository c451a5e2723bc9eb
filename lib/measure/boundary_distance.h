// measure: how far one boundary is from another. Depends on nearest_points.h, part_box.h.
#pragma once

#include <functional>

#include "nearest_points.h"
#include "part_box.h"

namespace tetstream {

struct DistanceFigures {
  double largest = 0;  // over the samples and all vertices of those triangles
  double place[3] = {0, 0, 0};
  double rms = 0, mean = 0;  // over the samples
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

// From `from` to the nearest points of all of `to`; all zero where `from` has no triangles,
// infinite where only `to` has none.
DistanceFigures boundaryDistance(SimplexRows& from, SimplexRows& to,
                                 const SurfaceSampling& sampling, const DistanceBudget& budget,
                                 const std::function<void(double)>& share);

}  // namespace tetstream
