// What bricks of a sample tell of the parts of a stream: only where they tell it of each other.
#include "sample_rates.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numeric>
#include <vector>

namespace tetstream::test {
namespace {

// A brick of a hundred cells in each of some parts, with a thousand vertices inside.
BrickLeft brickAt(size_t first_part, size_t parts, double rate) {
  BrickLeft brick;
  for (size_t k = first_part; k < first_part + parts; ++k) brick.cells[k] = 100;
  brick.inside = 1000;
  brick.left = std::round(1000 * rate);
  return brick;
}

// Four layers of four bricks. `rateOf` a layer and the place in it.
template <class RateOf>
std::vector<BrickLeft> layered(RateOf rateOf) {
  std::vector<BrickLeft> bricks;
  for (size_t layer = 0; layer < 4; ++layer)
    for (size_t place = 0; place < 4; ++place)
      bricks.push_back(brickAt(16 * layer, 16, rateOf(layer, place)));
  return bricks;
}

double meanOf(const std::vector<double>& rates) {
  return std::accumulate(rates.begin(), rates.end(), 0.0) / static_cast<double>(rates.size());
}

TEST(SampledRates, FollowLayers) {
  const auto bricks = layered(
      [](size_t layer, size_t place) { return 0.1 * double(1 + layer) + 0.01 * double(place); });
  for (double ratio : {0.6, 0.2}) {
    const std::vector<double> rates = sampledRates(bricks, ratio);
    ASSERT_EQ(rates.size(), kStreamParts);
    EXPECT_NEAR(meanOf(rates), ratio, 1e-6);
    EXPECT_GT(rates[56], 2.5 * rates[8]);
    EXPECT_LE(rates[56], 1);
  }
}

// Nor those that say the same.
TEST(SampledRates, DoNotFollowWhatDiffersWithinLayers) {
  const auto within = [](size_t, size_t place) { return 0.1 * double(1 + place); };
  EXPECT_EQ(sampledRates(layered(within), 0.3), std::vector<double>{0.3});
  EXPECT_EQ(sampledRates(layered([](size_t, size_t) { return 0.25; }), 0.3).size(), 1u);
}

// A mean over layers that is less sure than they differ.
TEST(SampledRates, DoNotFollowWhatIsRatherChance) {
  const auto mixed = [](double slope) {
    return layered([=](size_t layer, size_t place) {
      const double chance = (5 * place + 3 * layer) % 4 < 2 ? 0.1 : -0.1;
      return 0.25 + chance + slope * (double(layer) - 1.5);
    });
  };
  EXPECT_EQ(sampledRates(mixed(0.02), 0.3).size(), 1u);
  EXPECT_EQ(sampledRates(mixed(0.08), 0.3).size(), kStreamParts);
}

TEST(SampledRates, NeedSomeBricksAndSomethingLeft) {
  auto bricks = layered([](size_t layer, size_t) { return 0.1 * double(1 + layer); });
  for (size_t k : {14, 12, 10, 6, 4, 2, 0, 0, 0}) bricks.erase(bricks.begin() + long(k));
  ASSERT_EQ(bricks.size(), 7u);
  EXPECT_TRUE(sampledRates(bricks, 0.3).empty());
  EXPECT_TRUE(sampledRates({}, 0.3).empty());
  EXPECT_TRUE(sampledRates(layered([](size_t, size_t) { return 0.0; }), 0.3).empty());
}

// A part of which nothing was left is not given up, one without a brick is as those beside it.
TEST(SampledRates, KnowAllParts) {
  std::vector<BrickLeft> bricks;
  for (size_t k = 0; k < 8; ++k)
    for (int twice = 0; twice < 2; ++twice)
      if (k != 4) bricks.push_back(brickAt(8 * k, 8, k < 2 ? 0 : k < 6 ? 0.5 : 0.1));
  const std::vector<double> rates = sampledRates(bricks, 0.2);
  ASSERT_EQ(rates.size(), kStreamParts);
  EXPECT_GT(rates[0], 0.01);
  EXPECT_NEAR(rates[36], rates[24], 1e-9);
  EXPECT_LT(rates[60], 0.3 * rates[36]);
}

}  // namespace
}  // namespace tetstream::test
