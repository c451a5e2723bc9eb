// Cells in an image: who is nearest, and that nothing shows through.
#include "depth_image.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "random.h"

namespace tetstream::test {
namespace {

constexpr uint8_t kNear = 1, kFar = 2;

// A cell with a large face across the middle of a 20 x 20 image, at that depth.
void addFacing(DepthImage& image, float depth, uint8_t tag) {
  const Seen corners[4] = {{2, 2, depth}, {18, 2, depth}, {2, 18, depth}, {5, 5, depth + 3}};
  image.add(corners, tag);
}

TEST(DepthImage, ShowsTheNearestCell) {
  for (bool near_first : {true, false}) {
    Account account;
    DepthImage image(account, 20, 20);
    addFacing(image, near_first ? 1 : 5, near_first ? kNear : kFar);
    addFacing(image, near_first ? 5 : 1, near_first ? kFar : kNear);
    EXPECT_EQ(image.tag(6, 6), kNear);
    EXPECT_FLOAT_EQ(image.depth(6, 6), 1);
    EXPECT_EQ(image.tag(17, 17), DepthImage::kNothing);
    EXPECT_EQ(image.tag(0, 6), DepthImage::kNothing);
  }
}

// Whichever corner is which, the faces toward the eye are those that are seen.
TEST(DepthImage, DoesNotDependOnTheOrderOfCorners) {
  const Seen corners[4] = {{2, 2, 4}, {18, 3, 6}, {4, 18, 5}, {8, 7, 1}};
  Account account;
  DepthImage first(account, 20, 20);
  first.add(corners, kNear);
  int order[4] = {0, 1, 2, 3};
  do {
    const Seen moved[4] = {corners[order[0]], corners[order[1]], corners[order[2]],
                           corners[order[3]]};
    DepthImage image(account, 20, 20);
    image.add(moved, kNear);
    for (size_t y = 0; y < 20; ++y)
      for (size_t x = 0; x < 20; ++x) {
        ASSERT_EQ(image.tag(x, y), first.tag(x, y));
        const bool seen = first.tag(x, y) != DepthImage::kNothing;
        ASSERT_TRUE(!seen || std::fabs(image.depth(x, y) - first.depth(x, y)) < 1e-4);
      }
  } while (std::next_permutation(order, order + 4));
}

// A wall of cells side by side, of all sizes, has no holes.
TEST(DepthImage, LeavesNoGapsBetweenCells) {
  Random random(7);
  for (double size : {0.3, 1.0, 2.7, 11.0}) {
    Account account;
    DepthImage image(account, 40, 40);
    const int count = static_cast<int>(44 / size) + 2;
    std::vector<Seen> wall(static_cast<size_t>((count + 1) * (count + 1)));
    for (size_t i = 0; i < wall.size(); ++i) {
      const auto column = static_cast<double>(i % static_cast<size_t>(count + 1));
      const auto row = static_cast<double>(i / static_cast<size_t>(count + 1));
      const auto shift = [&] {
        return 0.4 * size * (static_cast<double>(random.below(1000)) / 1000);
      };
      wall[i] = {static_cast<float>(column * size - 1 - size / 2 + shift()),
                 static_cast<float>(row * size - 1 - size / 2 + shift()),
                 static_cast<float>(10 + shift())};
    }
    for (int row = 0; row < count; ++row)
      for (int column = 0; column < count; ++column) {
        const auto at = static_cast<size_t>(row * (count + 1) + column);
        const auto below = at + static_cast<size_t>(count) + 1;
        const Seen behind = {wall[at].x, wall[at].y, 100};
        const Seen upper[4] = {wall[at], wall[at + 1], wall[below], behind};
        const Seen lower[4] = {wall[at + 1], wall[below], wall[below + 1], behind};
        image.add(upper, kNear);
        image.add(lower, kNear);
      }
    for (size_t y = 0; y < 40; ++y)
      for (size_t x = 0; x < 40; ++x) {
        ASSERT_EQ(image.tag(x, y), kNear) << size << ": " << x << ", " << y;
        ASSERT_LT(image.depth(x, y), 10 + size);
      }
  }
}

void expectNone(const DepthImage& image, uint8_t tag) {
  for (size_t y = 0; y < image.height(); ++y)
    for (size_t x = 0; x < image.width(); ++x) EXPECT_NE(image.tag(x, y), tag);
}

TEST(DepthImage, LeavesOutWhatHasNoPlace) {
  Account account;
  DepthImage image(account, 8, 8);
  const float bad[] = {std::numeric_limits<float>::infinity(),
                       std::numeric_limits<float>::quiet_NaN(), 3e38f, -3e38f};
  for (float value : bad)
    for (int axis = 0; axis < 3; ++axis) {
      Seen corners[4] = {{1, 1, 1}, {7, 1, 1}, {1, 7, 1}, {2, 2, 3}};
      (axis == 0 ? corners[1].x : axis == 1 ? corners[1].y : corners[1].depth) = value;
      image.add(corners, std::isfinite(value) ? kNear : kFar);
    }
  const Seen outside[4] = {{100, 1, 1}, {107, 1, 1}, {101, 7, 1}, {102, 2, 3}};
  image.add(outside, kFar);
  const Seen flat[4] = {{1, 1, 1}, {5, 5, 1}, {3, 3, 1}, {7, 7, 2}};
  image.add(flat, kFar);
  expectNone(image, kFar);
}

// A wall that faces the light is brighter than one that faces away, and both are within 0 to 1.
TEST(DepthImage, LightsSlopes) {
  const auto lightOf = [](float slope) {
    Account account;
    DepthImage image(account, 20, 20);
    const Seen corners[4] = {
        {0, 0, 50}, {20, 0, 50 + 20 * slope}, {0, 20, 50}, {5, 5, 50 + 5 * slope + 500}};
    image.add(corners, kNear);
    return image.light(5, 5);
  };
  EXPECT_GT(lightOf(-0.5f), lightOf(0));
  EXPECT_GT(lightOf(0), lightOf(0.5f));
  EXPECT_LE(lightOf(-0.5f), 1);
  EXPECT_EQ(lightOf(50), 0);
}

}  // namespace
}  // namespace tetstream::test
