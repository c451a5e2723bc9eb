// The common part of two cells and integrals over it, where they are known.
#include "cell_overlap.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "cells_testing.h"

namespace tetstream::test {
namespace {

// The volume that both have, and into *overlap the rest.
double common(const Cell& a, const Cell& b, CellOverlap* overlap) {
  CellMap map;
  double planes[4][4];
  EXPECT_TRUE(map.set(b.data()));
  if (!map.planesOf(a.data(), planes) || !overlap->set(planes)) return 0;
  return overlap->volume * volumeOf(a);
}

TEST(CellOverlap, OfACellWithItselfIsTheCell) {
  CellOverlap o;
  EXPECT_NEAR(common(kCorner, kCorner, &o), 1.0 / 6, 1e-16);
  // The square of l0 over a cell: its volume / 10.
  const double first[4] = {1, 0, 0, 0}, one[4] = {1, 1, 1, 1};
  EXPECT_NEAR(o.integralOfSquare(first), 0.1, 1e-15);
  EXPECT_NEAR(o.integralOfSquare(one), 1, 1e-15);
}

TEST(CellOverlap, OfCornersMovedAlongTheDiagonal) {
  CellOverlap o;
  for (double s : {0.1, 0.2, 0.3}) {  // x, y, z >= s and x + y + z <= 1
    EXPECT_NEAR(common(kCorner, moved(kCorner, s, s, s), &o), std::pow(1 - 3 * s, 3) / 6, 1e-15);
    EXPECT_NEAR(common(moved(kCorner, s, s, s), kCorner, &o), std::pow(1 - 3 * s, 3) / 6, 1e-15);
  }
  EXPECT_EQ(common(kCorner, moved(kCorner, 0.4, 0.4, 0.4), &o), 0);
  EXPECT_EQ(common(kCorner, moved(kCorner, -1, 0, 0), &o), 0);  // they touch
}

TEST(CellOverlap, OfCellsInsideEachOtherIsTheSmallerOne) {
  CellOverlap o;
  const Cell small = moved(kCorner, 0.1, 0.1, 0.1, 0.3);
  EXPECT_NEAR(common(kCorner, small, &o), 0.027 / 6, 1e-16);
  EXPECT_NEAR(common(small, kCorner, &o), 0.027 / 6, 1e-16);
  EXPECT_EQ(o.pieces, 1);
}

TEST(CellOverlap, IsTheSameFromBothSidesAndForMirrorImages) {
  Random random(5);
  CellOverlap o;
  for (int n = 0; n < 2000; ++n) {
    Cell a(12), b(12);
    for (double& x : a) x = uniform(random);
    for (double& x : b) x = uniform(random);
    if (volumeOf(a) < 1e-3 || volumeOf(b) < 1e-3) continue;
    const double ab = common(a, b, &o), ba = common(b, a, &o);
    EXPECT_NEAR(ab, ba, 1e-13);
    EXPECT_LE(ab, std::min(volumeOf(a), volumeOf(b)) + 1e-14);
    std::swap_ranges(b.begin(), b.begin() + 3, b.begin() + 3);
    EXPECT_NEAR(common(a, b, &o), ab, 1e-13);
  }
}

// Against points spread in the first cell.
TEST(CellOverlap, IntegratesSquaresOfLinearFunctions) {
  Random random(7);
  const Cell b = moved(kCorner, 0.05, -0.1, 0.1, 0.9);
  CellOverlap o;
  common(kCorner, b, &o);
  CellMap map;
  ASSERT_TRUE(map.set(b.data()));
  const double d[4] = {1, -2, 0.5, 3};
  double sum = 0;
  constexpr int kPoints = 400000;
  for (int n = 0; n < kPoints; ++n) {
    double s[3] = {uniform(random), uniform(random), uniform(random)}, at[4];
    std::sort(s, s + 3);
    const double l[4] = {s[0], s[1] - s[0], s[2] - s[1], 1 - s[2]};
    const double place[3] = {l[1], l[2], l[3]};
    map.coordinates(place, at);
    const double value = l[0] * d[0] + l[1] * d[1] + l[2] * d[2] + l[3] * d[3];
    if (*std::min_element(at, at + 4) >= 0) sum += value * value;
  }
  EXPECT_NEAR(o.integralOfSquare(d), sum / kPoints, 0.01 * sum / kPoints);
}

TEST(CellOverlap, FlatCellsHaveNoCoordinates) {
  CellMap map;
  const Cell flat = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  EXPECT_FALSE(map.set(flat.data()));
  EXPECT_FALSE(map.set(Cell(12, 0.5).data()));
}

// However thin a cell is along an axis, its volume is no rounding.
TEST(CellOverlap, CellsThatAreThinAlongAnAxisHaveCoordinates) {
  const double size[3] = {1e9, 1, 1e-9};
  const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}};
  Cell thin;
  for (const auto& corner : corners)
    for (int i = 0; i < 3; ++i) thin.push_back(size[i] * corner[i]);
  CellMap map;
  ASSERT_TRUE(map.set(thin.data()));
  const double place[3] = {0.75 * size[0], 0.5 * size[1], 0.25 * size[2]};
  double at[4];
  map.coordinates(place, at);
  for (double share : at) EXPECT_NEAR(share, 0.25, 1e-12);
}

}  // namespace
}  // namespace tetstream::test
