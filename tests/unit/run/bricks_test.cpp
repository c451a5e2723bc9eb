// Bricks out of a box: of about as many vertices each, wherever those lie.
#include "bricks.h"

#include <gtest/gtest.h>
#include <cmath>
#include <map>
#include <vector>

#include "random.h"

namespace tetstream::test {
namespace {

Schema boxed(const std::vector<double>& low, const std::vector<double>& high) {
  Schema schema;
  schema.box_min = low;
  schema.box_max = high;
  return schema;
}

struct Point {
  double place[3];
};

// In a box, the denser the higher `power` is towards its lowest corner.
std::vector<Point> scattered(const Schema& schema, size_t count, double power) {
  Random random(7);
  std::vector<Point> points(count);
  for (Point& p : points)
    for (size_t i = 0; i < 3; ++i) {
      const double part = std::pow(static_cast<double>(random.below(1 << 20)) * 0x1p-20, power);
      p.place[i] = schema.box_min[i] + part * (schema.box_max[i] - schema.box_min[i]);
    }
  return points;
}

std::map<uint32_t, uint64_t> filled(const Bricks& bricks, const std::vector<Point>& points) {
  std::map<uint32_t, uint64_t> counts;
  for (const Point& p : points) ++counts[bricks.at(p.place)];
  return counts;
}

TEST(Bricks, AreFilledAlikeWhereverVerticesLie) {
  struct Case {
    double power, thickness;
    int64_t bytes;
  };
  const int64_t most = Bricks::kGridBytes;
  for (const auto& [power, thickness, bytes] :
       {Case{1, 1, most}, {2, 1, most}, {1, 1e-3, most}, {2, 1e-3, most}, {1, 1, 70000}}) {
    SCOPED_TRACE(::testing::Message()
                 << "power " << power << ", thickness " << thickness << ", bytes " << bytes);
    const Schema schema = boxed({-5, 1e3, 7}, {-4, 1e3 + 2, 7 + thickness});
    const std::vector<Point> points = scattered(schema, 100000, power);
    Bricks bricks(schema, bytes);
    for (const Point& p : points) bricks.count(p.place);
    bricks.take(20, 0.1);
    EXPECT_EQ(bricks.usual(), 500u);
    EXPECT_GT(bricks.size(), 15u);
    EXPECT_LE(bricks.size(), 20u);
    const auto counts = filled(bricks, points);
    EXPECT_EQ(counts.size(), bricks.size() + 1);  // and none
    for (const auto& [brick, count] : counts) {
      if (brick == Bricks::kNone) continue;
      EXPECT_GE(count, 125u) << brick;  // the smaller half of one that had too many
      EXPECT_LE(count, 700u) << brick;
    }
  }
}

// In one cell of the grid nobody knows where the vertices lie: a part of it is taken.
TEST(Bricks, AreCutWithinACell) {
  const Schema schema = boxed({0, 0, 0}, {1, 1, 1});
  const Schema corner = boxed({0, 0, 0}, {1.0 / 64, 1.0 / 64, 1.0 / 64});
  const std::vector<Point> points = scattered(corner, 100000, 1);
  Bricks bricks(schema);
  for (const Point& p : points) bricks.count(p.place);
  bricks.take(20, 0.1);
  ASSERT_EQ(bricks.size(), 1u);
  const auto counts = filled(bricks, points);
  EXPECT_GE(counts.at(0), 300u);
  EXPECT_LE(counts.at(0), 800u);
}

TEST(Bricks, OfNothingAreNone) {
  Bricks bricks(boxed({0, 0, 0}, {1, 1, 1}));
  bricks.take(20, 0.1);
  EXPECT_EQ(bricks.size(), 0u);
  const double place[3] = {0.5, 0.5, 0.5};
  EXPECT_EQ(bricks.at(place), Bricks::kNone);
}

// What is nowhere is counted somewhere, and in no brick.
TEST(Bricks, TakeAnyNumbers) {
  Bricks bricks(boxed({0, 0, 0}, {1, 1, 1}));
  const double corners[][3] = {{0, 0, 0}, {1, 1, 1}, {NAN, NAN, NAN}, {INFINITY, 7, 1e300}};
  for (const auto& corner : corners) bricks.count(corner);
  bricks.take(2, 1);
  ASSERT_EQ(bricks.size(), 2u);
  EXPECT_EQ(bricks.at(corners[0]), 0u);
  EXPECT_EQ(bricks.at(corners[1]), 1u);
  EXPECT_EQ(bricks.at(corners[2]), Bricks::kNone);
  EXPECT_EQ(bricks.at(corners[3]), Bricks::kNone);
}

}  // namespace
}  // namespace tetstream::test
