// Means of values at points: which values count, and how they are told.
#include "point_means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "slow_run.h"

namespace tetstream {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
const double kNotANumber = std::numeric_limits<double>::quiet_NaN();

using PointValues = std::vector<std::pair<uint64_t, double>>;

std::vector<double> meansOf(uint64_t points, const PointValues& values) {
  PointMeans means({"f", 1, ScalarType::kFloat64}, points, "", [&](size_t, auto add) {
    for (const auto& [point, value] : values) add(point, value);
  });
  std::vector<double> out(static_cast<size_t>(points));
  means.read(0, out.size(), out.data());
  return out;
}

double meanOf(const std::vector<double>& values) {
  PointValues all;
  for (double value : values) all.push_back({0, value});
  return meansOf(1, all)[0];
}

TEST(PointMeans, AreThoseOfEachPointInAnyOrder) {
  constexpr uint64_t kPoints = 1000;
  std::vector<double> sums(kPoints), counts(kPoints);
  PointValues values;
  std::mt19937 random(1);
  for (int n = 0; n < 10000; ++n) {
    const uint64_t point = random() % kPoints;
    values.push_back({point, static_cast<double>(random() % 1000)});
    sums[point] += values.back().second;
    ++counts[point];
  }
  const std::vector<double> means = meansOf(kPoints, values);
  for (size_t i = 0; i < kPoints; ++i)
    ASSERT_NEAR(means[i], counts[i] > 0 ? sums[i] / counts[i] : 0, 1e-11) << i;
}

// More points than are in memory at once, in no order.
TEST(PointMeans, OfManyValuesComeInOrder) {
  constexpr uint64_t kTimes = 3;
  const uint64_t points = test::slowRun() ? 1100000 : 2100000;  // two parts, or three
  PointMeans means({"f", 1, ScalarType::kFloat64}, points, "", [points](size_t, auto add) {
    for (uint64_t i = 0; i < kTimes * points; ++i)
      if (const uint64_t point = i * 7919 % points; point % 10 != 3)
        add(point, static_cast<double>(point) + static_cast<double>(i / points));
  });
  std::vector<double> out(points);
  means.read(0, points, out.data());
  for (uint64_t point = 0; point < points; ++point)
    ASSERT_EQ(out[point], point % 10 == 3 ? 0 : static_cast<double>(point) + 1) << point;
}

// However many values there are: the folder for files is none.
TEST(PointMeans, OfPointsThatAreInMemoryAtOnceTakeNoFile) {
  constexpr uint64_t kPoints = 100, kTimes = 10000;
  PointMeans means({"f", 1, ScalarType::kFloat64}, kPoints, "/nowhere", [](size_t, auto add) {
    for (uint64_t i = 0; i < kTimes * kPoints; ++i)
      add(i % kPoints, static_cast<double>(i % kPoints));
  });
  std::vector<double> out(kPoints);
  means.read(0, kPoints, out.data());
  for (size_t point = 0; point < kPoints; ++point)
    ASSERT_EQ(out[point], static_cast<double>(point));
}

TEST(PointMeans, OfPointsWithoutValuesAreZero) {
  EXPECT_EQ(meansOf(3, {}), (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(meansOf(5, {{3, 7}, {1, 4}}), (std::vector<double>{0, 4, 0, 7, 0}));
}

TEST(PointMeans, AreOfWhatIsFinite) {
  EXPECT_EQ(meanOf({kNotANumber, 1, kInfinite, 4, -kInfinite, 7}), 4);
  EXPECT_EQ(meanOf({kInfinite, kNotANumber}), kInfinite);
  EXPECT_EQ(meanOf({-kInfinite, kInfinite}), -kInfinite);
  EXPECT_TRUE(std::isnan(meanOf({kNotANumber, kInfinite})));
}

TEST(PointMeans, OfEqualValuesAreThatValue) {
  for (double value : {0.1, 1 / 3.0, 1e-320, 1e308, -1.7e308})
    for (size_t count : {1, 2, 3, 7, 10}) {
      EXPECT_EQ(meanOf(std::vector<double>(count, value)), value);
    }
}

TEST(PointMeans, OfLargeValuesAreNumbers) {
  const double largest = std::numeric_limits<double>::max();
  EXPECT_NEAR(meanOf({largest, -largest}) / largest, 0, 1e-15);
  EXPECT_NEAR(meanOf({largest, largest, -largest}) / largest, 1.0 / 3, 1e-15);
}

// Component by component, as the type of the column has it.
TEST(PointMeans, HaveTheTypeAndTheComponentsOfTheirColumn) {
  PointMeans means({"v", 2, ScalarType::kFloat32}, 3, "", [](size_t component, auto add) {
    const double sign = component == 0 ? 1 : -1;
    add(2, sign * 3);
    add(0, sign * 1);
    add(2, sign * 4);
  });
  float all[6], last[2];
  means.read(0, 3, all);
  const float expected[6] = {1, -1, 0, 0, 3.5, -3.5};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(all[i], expected[i]);
  means.read(2, 1, last);
  EXPECT_EQ(last[0], 3.5);
  EXPECT_EQ(last[1], -3.5);
}

}  // namespace
}  // namespace tetstream
