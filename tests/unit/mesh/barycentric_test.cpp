// A point as the weighted mean of a cell's corners, in round cells and in the thinnest.
#include "barycentric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random.h"

namespace tetstream::test {
namespace {

constexpr double kCorner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// How far the weighted mean is from the point, and the weights from a sum of 1.
double residual(const double p[4][3], const double x[3], const double w[4]) {
  double worst = std::fabs(w[0] + w[1] + w[2] + w[3] - 1);
  for (int i = 0; i < 3; ++i) {
    long double mean = 0;
    for (int k = 0; k < 4; ++k) mean += static_cast<long double>(w[k]) * p[k][i];
    worst = std::max(worst, std::fabs(static_cast<double>(mean - x[i])));
  }
  return worst;
}

TEST(Weights, AreThoseOfTheUnitCell) {
  const double x[3] = {0.5, 0.25, 0.125};
  double w[4];
  barycentricWeights(kCorner, x, w);
  EXPECT_EQ(w[0], 0.125);
  EXPECT_EQ(w[1], 0.5);
  EXPECT_EQ(w[2], 0.25);
  EXPECT_EQ(w[3], 0.125);
}

TEST(Weights, AreOneAtACornerAndElsewhereZero) {
  const double p[4][3] = {{0.1, 0.7, 0.3}, {1.3, 0.2, 0.9}, {0.4, 1.9, 0.6}, {0.8, 0.5, 2.1}};
  for (int corner = 0; corner < 4; ++corner) {
    double w[4];
    barycentricWeights(p, p[corner], w);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(w[k], k == corner ? 1 : 0);
  }
}

TEST(Weights, BelowZeroTellOfAPointOutside) {
  const double x[3] = {0.25, 0.25, -0.5};
  double w[4];
  barycentricWeights(kCorner, x, w);
  EXPECT_EQ(w[3], -0.5);
  EXPECT_EQ(w[0], 1.0);
}

TEST(Weights, OfAPointThatRoundingPutOutsideAreNotBelowZero) {
  const double x[3] = {0.25, 0.25, -1e-15};
  double w[4];
  barycentricWeights(kCorner, x, w);
  for (double weight : w) EXPECT_GE(weight, 0);
  EXPECT_LT(residual(kCorner, x, w), 1e-13);
}

// The thinner the cell, the less certain the weights, but not their mean.
TEST(Weights, GiveTheirPointBackInThinCells) {
  Random random(7);
  const auto number = [&] { return static_cast<double>(random.below(1u << 30)) / (1u << 29) - 1; };
  for (int run = 0; run < 2000; ++run) {
    double p[4][3], x[3] = {0, 0, 0}, w[4];
    const double height = std::pow(10.0, -(run % 12));
    for (auto& corner : p) {
      for (double& at : corner) at = number();
      corner[2] *= height;
    }
    double share[4], sum = 0;
    for (double& s : share) sum += s = number() + 1.1;
    for (int k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i) x[i] += share[k] / sum * p[k][i];
    barycentricWeights(p, x, w);
    EXPECT_LT(residual(p, x, w), 4e-15 * (1 + *std::max_element(w, w + 4))) << height;
  }
}

TEST(Weights, OfAFlatCellAreNumbers) {
  const double p[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, x[3] = {0.25, 0.5, 1};
  double w[4];
  barycentricWeights(p, x, w);
  for (double weight : w) EXPECT_TRUE(std::isfinite(weight));
  EXPECT_DOUBLE_EQ(w[0] + w[1] + w[2] + w[3], 1);
}

// Three corners that differ by rounding, far from the origin: one direction is all that the cell
// has.
TEST(Weights, StaySmallWhereACellHasAllButNoExtent) {
  const double p[4][3] = {
      {2e8, 6e8, 5e8 + 1e-7}, {2e8, 6e8 + 1e-7, 5e8}, {2e8, 6e8, 5e8}, {2e8, 6e8, 5e8 - 1e7}};
  const double x[3] = {2e8 - 4e6, 6e8 + 3e6, 5e8 - 2.5e6};
  double w[4], sum = 0;
  barycentricWeights(p, x, w);
  for (double weight : w) {
    EXPECT_LE(std::fabs(weight), 1.001);
    sum += weight;
  }
  EXPECT_NEAR(sum, 1, 1e-15);
  EXPECT_NEAR(w[3], 0.25, 1e-9);  // as high as x is
}

TEST(Weights, ClampedAreThoseOfAPointOfTheCell) {
  const double in[3] = {0.5, 0.25, 0.125}, out[3] = {1.5, 0.5, -0.5};
  double w[4] = {}, expected[4];
  clampedWeights(kCorner, in, w);
  barycentricWeights(kCorner, in, expected);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(w[k], expected[k]);
  clampedWeights(kCorner, out, w);  // -0.5, 1.5, 0.5 and -0.5 without
  EXPECT_EQ(w[0], 0);
  EXPECT_EQ(w[1], 0.75);
  EXPECT_EQ(w[2], 0.25);
  EXPECT_EQ(w[3], 0);
}

}  // namespace
}  // namespace tetstream::test
