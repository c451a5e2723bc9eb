// layout/graph: eigenvectors of a small symmetric matrix. Depends on nothing.
#pragma once

#include <cstddef>
#include <vector>

namespace tetstream {

struct Eigen {
  std::vector<double> values;   // ascending
  std::vector<double> vectors;  // [n][n], a row each, of length 1
};

// Jacobi's rotations, in O(n^3): for n up to some hundreds. `matrix` is [n][n].
Eigen symmetricEigen(std::vector<double> matrix, size_t n);

}  // namespace tetstream
