// orientation() against integers of any length, orientationLanes against orientation().
#include "orient.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "exact_reference.h"
#include "orient_lanes.inl"
#include "random.h"
#include "test_mesh.h"

namespace tetstream {

namespace test {
namespace {

using Points = std::array<std::array<double, 3>, 4>;

int signOf(const Points& p) {
  return orientation(p[0].data(), p[1].data(), p[2].data(), p[3].data());
}
int trueSignOf(const Points& p) {
  return referenceOrientation(p[0].data(), p[1].data(), p[2].data(), p[3].data());
}

// Even and odd permutations of the corners give the same and the opposite answer.
void expectExact(const Points& p) {
  const int truth = trueSignOf(p);
  EXPECT_EQ(signOf(p), truth);
  EXPECT_EQ(signOf({p[1], p[0], p[2], p[3]}), -truth);
  EXPECT_EQ(signOf({p[1], p[2], p[0], p[3]}), truth);
  EXPECT_EQ(signOf({p[3], p[1], p[2], p[0]}), -truth);
}

int rounds() {
  return slowRun() ? 20 : 400;
}

double random(Random& r, double size) {
  return size * (2.0 * static_cast<double>(r.next() >> 11) * 0x1p-53 - 1);
}

TEST(Orientation, OfTheUnitCellIsPositive) {
  const Points p = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  EXPECT_EQ(signOf(p), 1);
  expectExact(p);
}

// Small integers: every answer is known, and zero is frequent.
TEST(Orientation, IsExactForSmallIntegers) {
  Random r(1);
  int zeros = 0;
  for (int k = 0; k < 10 * rounds(); ++k) {
    Points p;
    for (auto& x : p)
      for (double& c : x) c = static_cast<int>(r.below(5)) - 2;
    expectExact(p);
    zeros += trueSignOf(p) == 0;
  }
  EXPECT_GT(zeros, rounds() / 4);
}

// Three random points and one in their plane but for rounding: what a filter cannot decide.
TEST(Orientation, IsExactForNearlyFlatCells) {
  Random r(2);
  int decided = 0;
  for (int k = 0; k < rounds(); ++k)
    for (double offset : {0.0, 1.0, 1e6}) {
      Points p;
      for (auto& x : p)
        for (double& c : x) c = offset + random(r, 1);
      const double s = random(r, 1), t = random(r, 1);
      for (size_t i = 0; i < 3; ++i)
        p[3][i] = p[0][i] + s * (p[1][i] - p[0][i]) + t * (p[2][i] - p[0][i]);
      expectExact(p);
      decided += trueSignOf(p) != 0;
    }
  EXPECT_GT(decided, rounds());
}

// A step of the last bit up or down from a plane.
TEST(Orientation, SeesTheLastBit) {
  for (double far : {1.0, 1048576.0, 1e9, 1e15}) {
    const double above = std::nextafter(far, 2 * far), below = std::nextafter(far, 0);
    const Points flat = {{{0, 0, far}, {1, 0, far}, {0, 1, far}, {0.3, 0.3, far}}};
    Points p = flat;
    EXPECT_EQ(signOf(p), 0);
    p[3][2] = above;
    EXPECT_EQ(signOf(p), 1);
    p[3][2] = below;
    EXPECT_EQ(signOf(p), -1);
    expectExact(p);
  }
}

TEST(Orientation, DoesNotDependOnTheUnit) {
  Random r(3);
  for (int k = 0; k < rounds(); ++k) {
    Points p;
    for (auto& x : p)
      for (double& c : x) c = static_cast<int>(r.below(1001)) - 500;
    const double s = static_cast<int>(r.below(5)), t = static_cast<int>(r.below(5));
    for (size_t i = 0; i < 3; ++i) {
      p[3][i] = p[0][i] + s * (p[1][i] - p[0][i]) + t * (p[2][i] - p[0][i]);
      if (k % 3 == 0) p[3][i] += static_cast<int>(r.below(3)) - 1;
    }
    const int truth = trueSignOf(p);
    for (int exponent : {-1060, -400, -358, -350, -340, -300, -20, 20, 300, 330, 400, 1000}) {
      Points q = p;
      for (auto& x : q)
        for (double& c : x) c = std::ldexp(c, exponent);
      EXPECT_EQ(signOf(q), truth) << "times 2^" << exponent;
    }
  }
}

// Fractions, times powers near the limits: here rounding of differences meets underflow.
TEST(Orientation, IsExactWhereProductsUnderflow) {
  Random r(4);
  for (int k = 0; k < rounds(); ++k)
    for (int exponent : {-1074, -1022, -420, -360, -355, -345}) {
      Points p;
      for (auto& x : p)
        for (double& c : x) c = std::ldexp(random(r, 1), exponent);
      const double s = random(r, 1), t = random(r, 1);
      for (size_t i = 0; i < 3; ++i)
        p[3][i] = p[0][i] + s * (p[1][i] - p[0][i]) + t * (p[2][i] - p[0][i]);
      expectExact(p);
    }
}

TEST(Orientation, IsExactWhereProductsOverflow) {
  Random r(5);
  for (int k = 0; k < rounds(); ++k) {
    Points p;
    for (auto& x : p)
      for (double& c : x) c = random(r, std::numeric_limits<double>::max());
    expectExact(p);
  }
}

// A needle along x, as thin as numbers go: the contract is any finite doubles.
TEST(Orientation, IsExactForCoordinatesOfVeryDifferentSize) {
  for (double thin : {1e-20, 1e-100, 1e-160, 1e-200, 1e-300, 4.9e-324})
    for (double length : {1e-10, 1.0, 1e100, 1e300}) {
      const Points p = {{{0, 0, 0}, {length, 0, 0}, {0, thin, 0}, {0, 0, thin}}};
      EXPECT_EQ(signOf(p), 1) << thin << " " << length;
      EXPECT_EQ(signOf({p[0], p[2], p[1], p[3]}), -1) << thin << " " << length;
    }
}

// ------------------------------------------------------------------------------------- lanes

TriangleLanes lanesOf(const std::vector<Points>& cells, double x[3]) {
  TriangleLanes triangles;
  for (size_t k = 0; k < static_cast<size_t>(kLanes); ++k) {
    const Points& p = cells[std::min(k, cells.size() - 1)];
    for (size_t i = 0; i < 3; ++i) {
      x[i] = p[0][i];
      for (size_t j = 0; j < 3; ++j) triangles.xyz[3 * j + i][k] = p[j + 1][i];
    }
  }
  return triangles;
}

// Sometimes regular numbers, sometimes nearly flat cells, round one centre.
std::vector<Points> cellsRoundAPoint(Random& r, double offset) {
  std::vector<Points> cells(8);
  for (Points& p : cells) {
    p[0] = {offset, offset / 2, -offset};
    for (size_t j = 1; j < 4; ++j)
      for (size_t i = 0; i < 3; ++i) p[j][i] = p[0][i] + random(r, 1);
    if (r.below(2)) continue;
    const double s = random(r, 1), t = random(r, 1);
    for (size_t i = 0; i < 3; ++i)
      p[3][i] = p[0][i] + s * (p[1][i] - p[0][i]) + t * (p[2][i] - p[0][i]);
  }
  return cells;
}

TEST(OrientationLanes, AgreeWithOrientationWhereTheyDecide) {
  Random r(6);
  int decided = 0, left = 0;
  for (int k = 0; k < rounds(); ++k)
    for (double scale : {1.0, 0x1p150, 0x1p-150}) {
      std::vector<Points> cells = cellsRoundAPoint(r, k % 2 ? 0.0 : 1e5);
      for (Points& p : cells)
        for (auto& x : p)
          for (double& c : x) c *= scale;
      double x[3], shape[kLanes];
      signed char sign[kLanes];
      const TriangleLanes triangles = lanesOf(cells, x);
      orientationLanes(x, triangles, kLanes, sign, shape);
      for (size_t i = 0; i < cells.size(); ++i) {
        sign[i] != 0 ? ++decided : ++left;
        if (sign[i] != 0) {
          EXPECT_EQ(sign[i], trueSignOf(cells[i]));
        }
      }
    }
  EXPECT_GT(decided, 8 * rounds());
  EXPECT_GT(left, rounds());
}

TEST(OrientationLanes, AreNeverWrongWhereProductsUnderflow) {
  Random r(7);
  for (int k = 0; k < rounds(); ++k)
    for (int exponent : {-360, -355, -350, -345}) {
      std::vector<Points> cells = cellsRoundAPoint(r, 0);
      for (Points& p : cells)
        for (auto& x : p)
          for (double& c : x) c = std::ldexp(c, exponent);
      double x[3], shape[kLanes];
      signed char sign[kLanes];
      const TriangleLanes triangles = lanesOf(cells, x);
      orientationLanes(x, triangles, kLanes, sign, shape);
      for (size_t i = 0; i < cells.size(); ++i)
        if (sign[i] != 0) {
          EXPECT_EQ(sign[i], trueSignOf(cells[i])) << "times 2^" << exponent;
        }
    }
}

// Of the regular cell: 1; of a flat one: 0; of a mirrored one: negative.
TEST(OrientationLanes, GiveShapes) {
  const Points regular = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
  const int side = trueSignOf(regular);
  Points flat = regular, mirrored = regular;
  flat[3] = {1, 0, 0};  // half way between the two before
  flat[2] = {1, 1, -1};
  flat[1] = {1, -1, 1};
  std::swap(mirrored[1], mirrored[2]);
  double x[3], shape[kLanes];
  signed char sign[kLanes];
  const TriangleLanes triangles = lanesOf({regular, mirrored, flat}, x);
  orientationLanes(x, triangles, 3, sign, shape);
  EXPECT_NEAR(shape[0], side, 1e-14);
  EXPECT_NEAR(shape[1], -side, 1e-14);
  EXPECT_EQ(shape[2], 0);
  EXPECT_EQ(sign[0], side);
  EXPECT_EQ(sign[1], -side);
  EXPECT_EQ(sign[2], 0);
  for (int k = 3; k < kLanes; ++k) {
    EXPECT_EQ(sign[k], 1);
    EXPECT_EQ(shape[k], 1);
  }
}

// Of the corner of a cube: 6V = 1, squared edges 3 * 1 + 3 * 2 = 9, so 20.785 / 27 = 0.7698.
TEST(OrientationLanes, GiveTheShapeOfACubesCorner) {
  const Points corner = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  double x[3], shape[kLanes];
  signed char sign[kLanes];
  const TriangleLanes triangles = lanesOf({corner}, x);
  orientationLanes(x, triangles, 1, sign, shape);
  EXPECT_NEAR(shape[0], std::pow(12, 1.5) / 2 / 27, 1e-14);
}

// orientationLanes takes the build for this processor; `lanes` is the plain one, built here.
TEST(OrientationLanes, GiveTheSameBitsFromEveryBuild) {
  Random r(8);
  for (int k = 0; k < rounds(); ++k)
    for (double scale : {1.0, 1e-3, 0x1p200, 0x1p-340}) {
      std::vector<Points> cells = cellsRoundAPoint(r, 10);
      for (Points& p : cells)
        for (auto& x : p)
          for (double& c : x) c *= scale;
      double x[3], shape[kLanes], plain_shape[kLanes];
      signed char sign[kLanes], plain_sign[kLanes];
      const TriangleLanes triangles = lanesOf(cells, x);
      orientationLanes(x, triangles, kLanes, sign, shape);
      lanes(x, triangles, plain_sign, plain_shape);
      EXPECT_EQ(0, std::memcmp(sign, plain_sign, sizeof sign));
      EXPECT_EQ(0, std::memcmp(shape, plain_shape, sizeof shape));
    }
}

}  // namespace
}  // namespace test
}  // namespace tetstream
