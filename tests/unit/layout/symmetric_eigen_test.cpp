// Eigenvectors of small symmetric matrices.
#include "symmetric_eigen.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random.h"

namespace tetstream::test {
namespace {

std::vector<double> randomSymmetric(size_t n, uint64_t seed) {
  Random random(seed);
  std::vector<double> matrix(n * n);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j <= i; ++j)
      matrix[i * n + j] = matrix[j * n + i] = random.below(2001) / 1000.0 - 1;
  return matrix;
}

TEST(SymmetricEigen, OfTwoByTwoIsAsSolvedByHand) {
  const Eigen eigen = symmetricEigen({2, 1, 1, 2}, 2);  // 1 along (1, -1), 3 along (1, 1)
  EXPECT_NEAR(eigen.values[0], 1, 1e-14);
  EXPECT_NEAR(eigen.values[1], 3, 1e-14);
  EXPECT_NEAR(eigen.vectors[0], -eigen.vectors[1], 1e-14);
  EXPECT_NEAR(eigen.vectors[2], eigen.vectors[3], 1e-14);
}

TEST(SymmetricEigen, VectorsAreOrthonormalAndSolveTheEquation) {
  for (size_t n : {1, 3, 12, 32}) {
    const auto matrix = randomSymmetric(n, n);
    const Eigen eigen = symmetricEigen(matrix, n);
    for (size_t k = 0; k < n; ++k) {
      const double* v = &eigen.vectors[k * n];
      EXPECT_LE(eigen.values[k == 0 ? 0 : k - 1], eigen.values[k]);
      for (size_t i = 0; i < n; ++i) {
        double product = 0, dot = 0;
        for (size_t j = 0; j < n; ++j) {
          product += matrix[i * n + j] * v[j];
          dot += eigen.vectors[i * n + j] * v[j];
        }
        EXPECT_NEAR(product, eigen.values[k] * v[i], 1e-12);
        EXPECT_NEAR(dot, i == k ? 1 : 0, 1e-12);
      }
    }
  }
}

TEST(SymmetricEigen, OfNothingIsNothing) {
  EXPECT_TRUE(symmetricEigen({}, 0).values.empty());
  for (double value : symmetricEigen(std::vector<double>(9, 0.0), 3).values) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace tetstream::test
