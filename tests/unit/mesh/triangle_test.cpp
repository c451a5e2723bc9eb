// A triangle's area, and its point nearest to a place, however thin the triangle is.
#include "triangle.h"

#include <gtest/gtest.h>
#include <algorithm>

#include "random_simplex.h"
#include "vector3.h"

namespace tetstream::test {
namespace {

const std::vector<double> kHalfSquare = {0, 0, 0, 1, 0, 0, 0, 1, 0};

// The coordinates are those of a point of the triangle that is as far away as is told. It is the
// nearest one: no corner lies beyond the plane through it across the way to the place.
void expectNearest(const std::vector<double>& corners, const double place[3], double tolerance) {
  double l[3], to[3];
  const double squared = squaredDistance(corners.data(), place, l);
  EXPECT_NEAR(l[0] + l[1] + l[2], 1, 1e-14);
  EXPECT_GE(*std::min_element(l, l + 3), 0);
  for (size_t k = 0; k < 3; ++k)
    to[k] = place[k] - l[0] * corners[k] - l[1] * corners[3 + k] - l[2] * corners[6 + k];
  EXPECT_NEAR(dot(to, to), squared, 1e-14);
  for (size_t i = 0; i < 3; ++i) {
    double beyond = 0;
    for (size_t k = 0; k < 3; ++k) beyond += to[k] * (corners[3 * i + k] - (place[k] - to[k]));
    EXPECT_LE(beyond, tolerance);
  }
}

void expectAt(const double place[3], double squared, const double expected[3]) {
  double l[3];
  EXPECT_DOUBLE_EQ(squaredDistance(kHalfSquare.data(), place, l), squared);
  for (int i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(l[i], expected[i]);
}

TEST(Triangle, HasHalfTheAreaOfItsParallelogram) {
  EXPECT_EQ(triangleArea(kHalfSquare.data()), 0.5);
  const double slanted[9] = {1, 1, 1, 3, 1, 1, 1, 4, 5};
  EXPECT_DOUBLE_EQ(triangleArea(slanted), 5);
  const double line[9] = {0, 0, 0, 1, 2, 3, 2, 4, 6};
  EXPECT_EQ(triangleArea(line), 0);
}

TEST(Triangle, IsNearestInsideAtAnEdgeOrAtACorner) {
  const double above[3] = {0.25, 0.5, -2}, inside[3] = {0.25, 0.25, 0.5};
  expectAt(above, 4, inside);
  const double beside[3] = {0.75, -3, 4}, on_first[3] = {0.25, 0.75, 0};
  expectAt(beside, 25, on_first);
  const double beyond[3] = {1, 1, 0}, on_second[3] = {0, 0.5, 0.5};
  expectAt(beyond, 0.5, on_second);
  const double left[3] = {-1, 0.25, 0}, on_third[3] = {0.75, 0, 0.25};
  expectAt(left, 1, on_third);
  const double far[3] = {3, -1, 0}, corner[3] = {0, 1, 0};
  expectAt(far, 5, corner);
}

TEST(Triangle, HasNoNearerPointThanItsNearest) {
  Random random(3);
  for (int n = 0; n < 20000; ++n) {
    const std::vector<double> corners = randomSimplex(random, 3, 1);
    expectNearest(corners, randomSimplex(random, 1, 1).data(), 1e-10);
    if (HasFailure()) return;
  }
}

// Two sides along each other, but for rounding or a little more, and places near them.
TEST(Triangle, HasItsNearestPointHoweverThinItIs) {
  Random random(4);
  for (double width : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e-2, 3e-2})
    for (double away : {1.0, 1e-3}) {
      for (int n = 0; n < 2000; ++n) {
        std::vector<double> corners = randomSimplex(random, 2, 1);
        const double third = uniform(random), near = uniform(random);
        double place[3];
        for (size_t k = 0; k < 3; ++k) {
          const double from = corners[k], side = corners[3 + k] - from;
          corners.push_back(from + third * side + width * uniform(random));
          place[k] = from + near * side + away * (uniform(random) - 0.5);
        }
        expectNearest(corners, place, 1e-7);
        if (HasFailure()) FAIL() << "as wide as " << width << ", a place as far as " << away;
      }
    }
}

TEST(Triangle, MayBeAPoint) {
  const std::vector<double> point = {1, 2, 3, 1, 2, 3, 1, 2, 3};
  const double place[3] = {1, 2, 5};
  double l[3];
  EXPECT_EQ(squaredDistance(point.data(), place, l), 4);
  expectNearest(point, place, 0);
}

}  // namespace
}  // namespace tetstream::test
