// The nearest points of a surface are those that a look at all its triangles finds, in pieces or
// not.
#include "nearest_points.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cells_testing.h"
#include "slow_run.h"
#include "triangle.h"

namespace tetstream::test {
namespace {

struct FoundPoint {
  std::vector<double> place, carried, values;
  double distance;
  bool operator==(const FoundPoint&) const = default;
};

struct Search {
  size_t in_core = 1 << 20, bytes = 1 << 20;
  const Tasks* tasks = nullptr;
};

// The values of the surface are the places of its corners, so those of a point its own place.
std::vector<FoundPoint> searched(const std::vector<std::vector<double>>& places,
                                 const std::vector<std::vector<double>>& triangles,
                                 const Search& search = {}) {
  constexpr size_t kCarried = 2, kValues = 3;
  Account account;
  NearestPoints nearest(kCarried, kValues, "");
  for (size_t i = 0; i < places.size(); ++i) {
    const double carried[kCarried] = {static_cast<double>(i), -1};
    nearest.add(places[i].data(), carried);
  }
  EXPECT_EQ(nearest.count(), places.size());
  const auto surface = rowsOf(
      triangles, {3, kValues}, [](const double* at) { return std::vector<double>(at, at + 3); },
      account, search.in_core);
  std::vector<FoundPoint> found;
  double shared = 0;
  nearest.search(
      *surface, {account, search.bytes, search.tasks},
      [&](const NearestPoints::Found& f) {
        found.push_back({{f.place, f.place + 3},
                         {f.carried, f.carried + kCarried},
                         {f.values, f.values + kValues},
                         f.distance});
      },
      [&](double share) {
        EXPECT_GE(share, shared);
        shared = share;
      });
  EXPECT_EQ(shared, places.empty() || triangles.empty() ? 0 : 1);
  return found;
}

std::vector<std::vector<double>> randomSimplices(uint64_t seed, size_t count, size_t corners,
                                                 double size) {
  Random random(seed);
  std::vector<std::vector<double>> simplices;
  for (size_t i = 0; i < count; ++i) simplices.push_back(randomSimplex(random, corners, size));
  return simplices;
}

double distanceTo(const std::vector<std::vector<double>>& triangles, const double* place) {
  double least = std::numeric_limits<double>::infinity(), l[3];
  for (const std::vector<double>& triangle : triangles)
    least = std::min(least, squaredDistance(triangle.data(), place, l));
  return std::sqrt(least);
}

void expectNearestOf(const std::vector<std::vector<double>>& places,
                     const std::vector<std::vector<double>>& triangles, const Search& search) {
  const std::vector<FoundPoint> found = searched(places, triangles, search);
  ASSERT_EQ(found.size(), places.size());
  for (size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].place, places[i]);
    ASSERT_EQ(found[i].carried, (std::vector{static_cast<double>(i), -1.0}));
    ASSERT_EQ(found[i].distance, distanceTo(triangles, places[i].data()));
    double way[3];
    subtract(found[i].values.data(), places[i].data(), way);
    ASSERT_NEAR(std::sqrt(dot(way, way)), found[i].distance, 1e-14);
  }
}

TEST(NearestPoints, AreThoseOfALookAtAllTriangles) {
  expectNearestOf(randomSimplices(1, 1000, 1, 1), randomSimplices(2, 300, 3, 0.2), {});
}

// Places and triangles in files, triangles some at a time; more places than are looked at at once.
TEST(NearestPoints, AreTheSameInPieces) {
  const auto places = randomSimplices(1, slowRun() ? 1500 : 5000, 1, 1),
             triangles = randomSimplices(2, 80, 3, 0.2);
  for (size_t bytes : {1, 2000, 10000}) expectNearestOf(places, triangles, {500, bytes});
}

TEST(NearestPoints, AreTheSameForAnyNumberOfThreads) {
  const auto places = randomSimplices(3, 3000, 1, 1), triangles = randomSimplices(4, 50, 3, 0.2);
  const Tasks tasks(3);
  EXPECT_EQ(searched(places, triangles), searched(places, triangles, {1 << 20, 1 << 20, &tasks}));
  EXPECT_EQ(searched(places, triangles, {500, 4000}),
            searched(places, triangles, {500, 4000, &tasks}));
}

TEST(NearestPoints, AreOneOfThoseThatAreJustAsNear) {
  const std::vector<std::vector<double>> sides = {{-1, 0, 0, -1, 1, 0, -1, 0, 1},
                                                  {1, 0, 0, 1, 1, 0, 1, 0, 1}};
  for (size_t bytes : {1, 1 << 20}) {
    const auto found = searched({{0, 0.25, 0.25}}, sides, {1 << 20, bytes});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].distance, 1);
    EXPECT_EQ(std::fabs(found[0].values[0]), 1);
    EXPECT_DOUBLE_EQ(found[0].values[1], 0.25);
    EXPECT_DOUBLE_EQ(found[0].values[2], 0.25);
  }
}

TEST(NearestPoints, AreFoundOnTrianglesThatAreLinesOrPoints) {
  const std::vector<std::vector<double>> flat = {{0, 0, 0, 2, 0, 0, 1, 0, 0},
                                                 {0, 5, 0, 0, 5, 0, 0, 5, 0}};
  const auto found = searched({{1.5, 0, 2}, {0, 4, 0}}, flat);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].distance, 2);
  EXPECT_EQ(found[0].values, (std::vector{1.5, 0.0, 0.0}));
  EXPECT_EQ(found[1].distance, 1);
  EXPECT_EQ(found[1].values, (std::vector{0.0, 5.0, 0.0}));
}

TEST(NearestPoints, OfNoSurfaceAreInfinitelyFar) {
  const auto places = randomSimplices(5, 4000, 1, 1);
  const auto found = searched(places, {});
  ASSERT_EQ(found.size(), places.size());
  for (size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].place, places[i]);
    ASSERT_EQ(found[i].carried[0], static_cast<double>(i));
    ASSERT_EQ(found[i].distance, std::numeric_limits<double>::infinity());
  }
}

TEST(NearestPoints, OfNoPlacesAreNone) {
  EXPECT_TRUE(searched({}, randomSimplices(6, 50, 3, 1)).empty());
  EXPECT_TRUE(searched({}, randomSimplices(6, 50, 3, 1), {500, 2000}).empty());
  EXPECT_TRUE(searched({}, {}).empty());
}

}  // namespace
}  // namespace tetstream::test
