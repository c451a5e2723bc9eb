// Corners of cells and triangles at random.
#pragma once

#include <cstddef>
#include <vector>

#include "mix.h"
#include "random.h"

namespace tetstream::test {

// From 0 to 1.
inline double uniform(Random& random) {
  return tetstream::uniform(random.next());
}

// The corners of a cell or triangle whose sides are about so long, within the unit cube and as far
// beside it.
inline std::vector<double> randomSimplex(Random& random, size_t corners, double size) {
  const double low[3] = {uniform(random), uniform(random), uniform(random)};
  std::vector<double> simplex;
  for (size_t i = 0; i < 3 * corners; ++i) simplex.push_back(low[i % 3] + size * uniform(random));
  return simplex;
}

}  // namespace tetstream::test
