// Pieces of a list of points: how large, how far apart, whatever the order.
#include "median_cut.h"

#include <gtest/gtest.h>
#include <array>
#include <numeric>
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
  medianCut(ids.data(), 0, ids.size(), rule, at, leaf);
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
    const std::vector<Ids> leaves = leavesOf(line(axis, 8), {7, 2, 5, 0, 4, 6, 1, 3}, {0.5, 4});
    EXPECT_EQ(leaves, (std::vector<Ids>{{0, 1, 2, 3}, {4, 5, 6, 7}}));
  }
}

// Of 10 there are 3 before the first cut; then of 7 there are 2, of 5 there is 1.
TEST(MedianCut, LeavesTheShareBeforeTheCut) {
  const std::vector<Ids> leaves = leavesOf(line(1, 10), {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {0.36, 4});
  EXPECT_EQ(leaves, (std::vector<Ids>{{0, 1, 2}, {3, 4}, {5}, {6, 7, 8, 9}}));
}

// Sides of equal length: the first is cut. Points of equal place: the lower id comes first.
TEST(MedianCut, DecidesTies) {
  const Points square = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  EXPECT_EQ(leavesOf(square, {3, 2, 1, 0}, {0.5, 2}), (std::vector<Ids>{{0, 1}, {2, 3}}));
  EXPECT_EQ(leavesOf(Points(4), {3, 1, 2, 0}, {0.5, 2}), (std::vector<Ids>{{0, 1}, {2, 3}}));
}

TEST(MedianCut, DoesNotDependOnTheOrder) {
  Random r(3);
  Points points(500);
  for (auto& point : points)
    for (float& x : point) x = static_cast<float>(r.below(9));  // many equal ones
  Ids ids(points.size());
  std::iota(ids.begin(), ids.end(), 0u);
  const std::vector<Ids> leaves = leavesOf(points, ids, {0.64, 20});
  Ids all;
  for (const Ids& leaf : leaves) {
    EXPECT_TRUE(!leaf.empty() && leaf.size() <= 20u);
    EXPECT_TRUE(std::is_sorted(leaf.begin(), leaf.end()));
    all.insert(all.end(), leaf.begin(), leaf.end());
  }
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, ids);
  for (size_t i = ids.size(); i > 1; --i)
    std::swap(ids[i - 1], ids[r.below(static_cast<uint32_t>(i))]);
  EXPECT_EQ(leavesOf(points, ids, {0.64, 20}), leaves);
}

}  // namespace
}  // namespace tetstream::test
