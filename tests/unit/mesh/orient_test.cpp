// orientation() against integers of any length.
#include "orient.h"

#include <gtest/gtest.h>
#include <array>
#include <cmath>
#include <limits>

#include "exact_reference.h"
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

TEST(LargestDifference, IsThatOfTheCoordinatesAndNeverZero) {
  const double a[3] = {1, 2, 3}, b[3] = {1, 2, 4}, c[3] = {-1.5, 2, 3}, d[3] = {1, 3, 3};
  EXPECT_EQ(largestDifference(a, b, c, d), 2.5);
  EXPECT_EQ(largestDifference(b, a, c, d), 2.5);
  EXPECT_GT(largestDifference(a, a, a, a), 0);
  EXPECT_LT(largestDifference(a, a, a, a), 1e-300);
}

}  // namespace
}  // namespace test
}  // namespace tetstream
