// The thinness of cells whose angles are known.
#include "thinness.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace tetstream::test {
namespace {

using Cell = std::array<std::array<double, 3>, 4>;

double of(const Cell& cell) {
  double p[4][3];
  for (size_t k = 0; k < 4; ++k)
    for (size_t i = 0; i < 3; ++i) p[k][i] = cell[k][i];
  return thinness(p);
}

// Edges 0 1 and 2 3 cross at right angles at a distance: a sliver as that goes to 0, with two
// angles near 180 and four small ones.
Cell sliver(double height, double size = 1) {
  return {{{-size, 0, 0}, {size, 0, 0}, {0, size, height * size}, {0, -size, height * size}}};
}

TEST(Thinness, IsTheSquaredCosineOfTheSmallestAngle) {
  const Cell regular = {{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}};
  EXPECT_NEAR(of(regular), 1.0 / 9, 1e-15);
  const Cell corner = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  EXPECT_NEAR(of(corner), 1.0 / 3, 1e-15);
  EXPECT_NEAR(thinnessOfAngle(60), 0.25, 1e-15);
  EXPECT_EQ(thinnessOfAngle(0), 1);
}

TEST(Thinness, RegularityBoundsTheSmallestAngle) {
  const auto regularityOf = [](const Cell& cell, double scale) {
    double p[4][3];
    for (size_t k = 0; k < 4; ++k) std::copy(cell[k].begin(), cell[k].end(), p[k]);
    return regularity(p, scale);
  };
  const Cell regular = {{{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}};
  EXPECT_NEAR(regularityOf(regular, 1), 1, 1e-15);
  EXPECT_NEAR(regularityOf(regular, 1024), 1, 1e-15);
  EXPECT_EQ(regularityOf(sliver(0), 1), 0);
  EXPECT_FALSE(regularityOf(sliver(1, 1e-120), 1) > 0);  // no number: it says nothing
  for (double height : {1.0, 0.3, 0.1, 0.01}) {
    const double sine2 = 1 - of(sliver(height));  // of the smallest angle
    EXPECT_LE(regularityOf(sliver(height), 1), 4 * sine2) << height;
  }
}

TEST(Thinness, FollowsTheAngleWhateverTheUnitAndTheOrderOfCorners) {
  for (double height : {1.0, 0.3, 0.01}) {
    // The faces at 0 1 have normals (0, +-h, 1), those at 2 3 (+-h, 0, 1): four angles between the
    // pairs have the cosine 1 / (1 + h^2).
    const double expected = std::pow(1 / (1 + height * height), 2);
    for (double unit : {1.0, 1e-30, 1e30}) {
      Cell cell = sliver(height, unit);
      EXPECT_NEAR(of(cell), expected, 1e-12) << height;
      std::swap(cell[0], cell[1]);
      std::swap(cell[2], cell[3]);
      EXPECT_NEAR(of(cell), expected, 1e-12);
    }
  }
}

TEST(Thinness, OfATurnedOrFlatCellIsWorseThanAny) {
  Cell cell = sliver(0.1);
  std::swap(cell[0], cell[1]);
  EXPECT_EQ(of(cell), kTurned);
  EXPECT_EQ(of(sliver(0)), kTurned);
  EXPECT_LE(of(sliver(1e-12)), 1);
}

// Rows of four numbers, the last of no meaning; of each kind of cell some among others.
template <class S>
void expectFourAreAsEach(const std::vector<Cell>& cells) {
  std::vector<S> values;
  std::vector<std::array<uint32_t, 4>> corners;
  for (const Cell& cell : cells) {
    auto& of = corners.emplace_back();
    for (size_t k = 0; k < 4; ++k) {
      of[k] = static_cast<uint32_t>(values.size() / 4);
      for (double x : cell[k]) values.push_back(static_cast<S>(x));
      values.push_back(std::numeric_limits<S>::quiet_NaN());
    }
  }
  for (size_t first = 0; first + kThinLanes <= cells.size(); ++first) {
    uint32_t four[kThinLanes][4];
    double found[kThinLanes];
    for (size_t i = 0; i < kThinLanes; ++i) std::copy_n(corners[first + i].begin(), 4, four[i]);
    thinnessOfFour(values.data(), 4, four, found);
    for (size_t i = 0; i < kThinLanes; ++i) {
      double p[4][3];
      for (size_t k = 0; k < 4; ++k)
        for (size_t j = 0; j < 3; ++j) p[k][j] = static_cast<double>(values[4 * four[i][k] + j]);
      EXPECT_EQ(found[i], thinness(p)) << first << " " << i;
    }
  }
}

TEST(Thinness, OfFourCellsIsToTheLastBitThatOfEach) {
  std::vector<Cell> cells;
  uint32_t state = 1;
  const auto number = [&state] { return ((state = state * 1664525 + 1013904223) >> 8) * 0x1p-24; };
  for (int i = 0; i < 400; ++i) {
    Cell& cell = cells.emplace_back();
    for (auto& corner : cell)
      for (double& x : corner) x = number();
    if (i % 5 == 1)  // in a plane of an axis, and in an oblique one
      for (auto& corner : cell) corner[i % 3] = i % 2 ? 0.25 : corner[(i + 1) % 3];
    if (i % 5 == 2) cell[3] = cell[0];
    if (i % 5 == 3)  // flat but for the rounding
      for (size_t k = 0; k < 3; ++k) cell[3][k] = (cell[0][k] + cell[1][k] + cell[2][k]) / 3;
    if (i % 7 == 4)
      for (auto& corner : cell)
        for (double& x : corner) x *= i % 2 ? 1e-30 : 1e30;
  }
  expectFourAreAsEach<double>(cells);
  expectFourAreAsEach<float>(cells);
}

}  // namespace
}  // namespace tetstream::test
