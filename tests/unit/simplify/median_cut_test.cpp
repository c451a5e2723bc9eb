// Pieces of a list of points: how large, how far apart, whatever the order.
#include "median_cut.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <numeric>
#include <thread>
#include <vector>

#include "random.h"

namespace tetstream::test {
namespace {

using Ids = std::vector<uint32_t>;
using Points = std::vector<std::array<float, 3>>;

std::vector<Ids> leavesOf(const Points& points, Ids ids, const CutRule& rule) {
  std::vector<Ids> leaves;
  const auto at = [&](uint32_t id, int axis) { return points[id][static_cast<size_t>(axis)]; };
  const auto leaf = [&](size_t begin, size_t end) {
    leaves.push_back(
        {ids.begin() + static_cast<ptrdiff_t>(begin), ids.begin() + static_cast<ptrdiff_t>(end)});
  };
  MedianCut(ids.data(), ids.size(), rule, at).cut(0, ids.size(), leaf);
  return leaves;
}

// Points 0, 1, 2, ... along an axis.
Points line(size_t axis, size_t count) {
  Points points(count);
  for (size_t i = 0; i < count; ++i) points[i][axis] = static_cast<float>(i);
  return points;
}

TEST(MedianCut, CutsAcrossTheLongestSide) {
  for (size_t axis = 0; axis < 3; ++axis) {
    const std::vector<Ids> leaves = leavesOf(line(axis, 8), {0, 1, 2, 3, 4, 5, 6, 7}, {0.5, 4});
    EXPECT_EQ(leaves, (std::vector<Ids>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  }
}

// Of 10 there are 3 before the first cut; then of 7 there are 2, of 5 there is 1.
TEST(MedianCut, LeavesTheShareBeforeTheCut) {
  const std::vector<Ids> leaves = leavesOf(line(1, 10), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {0.36, 4});
  EXPECT_EQ(leaves, (std::vector<Ids>{{0, 1, 2}, {3, 4}, {5}, {6, 7, 8, 9}}));
}

// A layer across z holds most of the points, and a few lie far below: the box is longest along z,
// but most would lie beside such a cut.
TEST(MedianCut, CutsALayerAcross) {
  Points points;
  for (int i = 0; i < 100; ++i)
    points.push_back({static_cast<float>(i / 10), static_cast<float>(i % 10 * 2), 0});
  for (int i = 0; i < 20; ++i) points.push_back({5, 9, -10.0f * static_cast<float>(i)});
  Ids ids(points.size());
  std::iota(ids.begin(), ids.end(), 0u);
  const auto spans = [&](const std::vector<Ids>& leaves, size_t axis) {  // of the layer in each
    std::vector<float> wide;
    for (const Ids& leaf : leaves) {
      float low = 1e9f, high = -1e9f;
      for (uint32_t id : leaf) {
        if (id >= 100) continue;
        low = std::min(low, points[id][axis]);
        high = std::max(high, points[id][axis]);
      }
      wide.push_back(high - low);
    }
    return wide;
  };
  const auto longest = leavesOf(points, ids, {0.5, 60});
  const auto sparsest = leavesOf(points, ids, {0.5, 60, false, CutSide::kSparsest});
  ASSERT_EQ(longest.size(), 2u);
  ASSERT_EQ(sparsest.size(), 2u);
  EXPECT_EQ(spans(sparsest, 1), (std::vector<float>{8, 8}));   // 18 in all
  EXPECT_EQ(spans(longest, 1), (std::vector<float>{18, 18}));  // along z
}

// Where the places beside a cut are all equal, of thousands of points, the box tells.
TEST(MedianCut, CutsTheLongestSideOfEqualPlaces) {
  Points points(3000);
  for (size_t i = 0; i < 100; ++i) points[i][1] = -1 - static_cast<float>(i);
  Ids ids(points.size());
  std::iota(ids.begin(), ids.end(), 0u);
  const CutRule rule{0.5, 2000, false, CutSide::kSparsest};
  EXPECT_EQ(leavesOf(points, ids, rule), leavesOf(points, ids, {0.5, 2000}));
}

// As many as whole leaves hold: 10 in three leaves of 4 at most, of which the share is 1.08.
TEST(MedianCut, FillsItsLeaves) {
  const Ids ids = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  EXPECT_EQ(leavesOf(line(1, 10), ids, {0.36, 4, true}),
            (std::vector<Ids>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8, 9}}));
  Random r(7);
  for (int round = 0; round < 1000; ++round) {
    const CutRule rule{r.below(2) == 0 ? 0.36 : 0.64, 1 + r.below(40), true};
    const size_t count = rule.most + 1 + r.below(2000), before = rule.before(count);
    ASSERT_TRUE(before > 0 && before < count);
    EXPECT_EQ(rule.leavesOf(count), (count - 1) / rule.most + 1);
  }
}

std::vector<Ids> slicesOf(const Points& points, size_t count, bool half_on) {
  Ids ids(points.size());
  std::iota(ids.begin(), ids.end(), 0u);
  std::vector<Ids> slices;
  const auto at = [&](uint32_t id, int axis) { return points[id][static_cast<size_t>(axis)]; };
  MedianCut(ids.data(), ids.size(), {0.5, 1}, at)
      .slice(0, ids.size(), count, half_on, [&](size_t begin, size_t end) {
        slices.push_back({ids.begin() + static_cast<ptrdiff_t>(begin),
                          ids.begin() + static_cast<ptrdiff_t>(end)});
      });
  return slices;
}

// Along one axis, also where a slice is longer across it than along it.
TEST(MedianCut, SlicesAreOfOneSizeOrBeginAndEndWithHalves) {
  Points points = line(2, 8);
  for (size_t i = 0; i < 8; ++i) points[i][0] = i % 2 ? 6 : 0;
  EXPECT_EQ(slicesOf(points, 4, false), (std::vector<Ids>{{0, 1}, {2, 3}, {4, 5}, {6, 7}}));
  EXPECT_EQ(slicesOf(points, 4, true), (std::vector<Ids>{{0}, {1, 2}, {3, 4}, {5, 6}, {7}}));
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(slicesOf(points, 2, false), (std::vector<Ids>{{4, 5, 6, 7}, {0, 1, 2, 3}}));
}

// Never one of no points.
TEST(MedianCut, OfFewPointsThereAreFewerSlices) {
  EXPECT_EQ(slicesOf(line(0, 2), 8, true), (std::vector<Ids>{{0}, {1}}));
  EXPECT_EQ(slicesOf(line(0, 1), 4, false), (std::vector<Ids>{{0}}));
}

// Sides of equal length: the first is cut. Points of equal place: the lower id comes first.
TEST(MedianCut, DecidesTies) {
  const Points square = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  EXPECT_EQ(leavesOf(square, {0, 1, 2, 3}, {0.5, 2}), (std::vector<Ids>{{0, 1}, {2, 3}}));
  EXPECT_EQ(leavesOf(Points(4), {0, 1, 2, 3}, {0.5, 2}), (std::vector<Ids>{{0, 1}, {2, 3}}));
}

// As two threads share the work.
TEST(MedianCut, PartsAreCutByThemselves) {
  Random r(5);
  Points points(3000);
  for (auto& point : points)
    for (float& x : point) x = static_cast<float>(r.below(1000));
  const auto at = [&](uint32_t id, int axis) { return points[id][static_cast<size_t>(axis)]; };
  Ids ids(points.size());
  std::iota(ids.begin(), ids.end(), 0u);
  const CutRule rule{0.36, 50};
  const std::vector<Ids> expected = leavesOf(points, ids, rule);
  EXPECT_EQ(rule.leavesOf(ids.size()), expected.size());
  MedianCut pieces(ids.data(), ids.size(), rule, at);
  const size_t middle = pieces.cutOnce(0, ids.size());
  EXPECT_EQ(middle, rule.before(ids.size()));
  std::vector<Ids> leaves(expected.size());
  const auto cutPart = [&](size_t begin, size_t end, size_t leaf) {
    pieces.cut(begin, end, [&](size_t first, size_t last) {
      leaves[leaf++].assign(ids.begin() + static_cast<ptrdiff_t>(first),
                            ids.begin() + static_cast<ptrdiff_t>(last));
    });
  };
  std::thread second([&] { cutPart(middle, ids.size(), rule.leavesOf(middle)); });
  cutPart(0, middle, 0);
  second.join();
  EXPECT_EQ(leaves, expected);
}

// Against sorting; some places equal, some far away, some beyond what differences hold.
TEST(MedianCut, CutsWhereSortingWould) {
  Random r(3);
  for (float far : {1.0f, 1e6f, 3e38f}) {
    Points points(500);
    for (auto& point : points)
      for (float& x : point) x = static_cast<float>(r.below(9)) + (r.below(50) == 0 ? far : 0);
    for (size_t i = 0; i < points.size(); i += 100) points[i][0] = -far;
    Ids ids(points.size());
    std::iota(ids.begin(), ids.end(), 0u);
    Ids all;
    for (const Ids& leaf : leavesOf(points, ids, {0.64, 20})) {
      EXPECT_TRUE(!leaf.empty() && leaf.size() <= 20u);
      EXPECT_TRUE(std::is_sorted(leaf.begin(), leaf.end()));
      all.insert(all.end(), leaf.begin(), leaf.end());
    }
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, ids);
    const auto before = [&](uint32_t a, uint32_t b) {
      return std::pair(points[a][0], a) < std::pair(points[b][0], b);
    };
    for (auto& point : points) point[1] = point[2] = 0;  // cut once, across x
    Ids sorted = ids;
    std::sort(sorted.begin(), sorted.end(), before);
    const std::vector<Ids> halves = leavesOf(points, ids, {0.64, 320});
    ASSERT_EQ(halves.size(), 2u);
    std::sort(sorted.begin(), sorted.begin() + 320);
    std::sort(sorted.begin() + 320, sorted.end());
    EXPECT_EQ(halves[0], Ids(sorted.begin(), sorted.begin() + 320));
    EXPECT_EQ(halves[1], Ids(sorted.begin() + 320, sorted.end()));
  }
}

}  // namespace
}  // namespace tetstream::test
