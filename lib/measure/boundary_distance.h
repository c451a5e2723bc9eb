// measure: how far one boundary is from another. Depends on nearest_points.h.
#pragma once

#include <functional>

#include "nearest_points.h"

namespace tetstream {

struct DistanceFigures {
  double largest = 0;  // over the samples and all vertices of the first boundary
  double place[3] = {0, 0, 0};
  double rms = 0, mean = 0;  // over the samples
};

// About `samples` points, uniform by area, of a boundary of that area.
struct SurfaceSampling {
  int64_t samples;
  uint64_t seed;
  double area;
};

struct SearchBudget {
  Account& account;
  std::string temp_dir;
  size_t bytes;
};

// From `from` to the nearest points of `to`; all zero where one of them has no triangles.
DistanceFigures boundaryDistance(SimplexRows& from, SimplexRows& to,
                                 const SurfaceSampling& sampling, const SearchBudget& budget,
                                 const std::function<void(double)>& share);

}  // namespace tetstream
