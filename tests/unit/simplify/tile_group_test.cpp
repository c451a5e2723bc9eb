// Which tiles of a pass are swept at the same time, and how much each may take.
#include "tile_group.h"

#include <gtest/gtest.h>

namespace tetstream::test {
namespace {

constexpr int64_t kCellsOfTile = 1000, kCellsOfTen = 10 * kCellsOfTile;

std::vector<TilePiece> tenTiles() {
  return std::vector<TilePiece>(10, {0, 0, kCellsOfTile, 0, 0});
}
Goal goalToLeave(int64_t cells, bool last) {
  return {cells, cells, last};
}

TEST(TileGroups, AreThoseThatCannotMeetTheGoal) {
  for (bool last : {false, true}) {
    const TileGroup group = groupFrom(tenTiles(), 0, kCellsOfTen, goalToLeave(1500, last), kAlike);
    EXPECT_EQ(group.end, 8u);
    EXPECT_EQ(group.share, 1);
  }
}

TEST(TileGroups, AreHalfOfTheTilesTowardsTheLastGoal) {
  const Goal goal = goalToLeave(8000, true);
  const TileGroup group = groupFrom(tenTiles(), 0, kCellsOfTen, goal, kAlike);
  EXPECT_EQ(group.end, 5u);
  EXPECT_DOUBLE_EQ(group.share, 0.4);
  const TileGroup next = groupFrom(tenTiles(), 5, kCellsOfTen - 1000, goal, kAlike);
  EXPECT_EQ(next.end, 7u);
  EXPECT_DOUBLE_EQ(next.share, 0.5);
}

TEST(TileGroups, TakeNoMoreThanIsLeft) {
  for (int64_t left = 100; left < kCellsOfTen; left += 100) {
    const Goal goal = goalToLeave(kCellsOfTen - left, true);
    for (double least : {kAlike, kLeastShare, kLeastShareOfSlices}) {
      const TileGroup group = groupFrom(tenTiles(), 0, kCellsOfTen, goal, least);
      if (group.end == 1) continue;
      const double of_tile = group.share * static_cast<double>(kCellsOfTile);
      EXPECT_LE(static_cast<int64_t>(of_tile) * static_cast<int64_t>(group.end), left)
          << "with at least " << least;
    }
  }
}

TEST(TileGroups, AreOneTileWhereLittleIsLeft) {
  for (int64_t left : {1, 100, 400}) {
    const TileGroup group =
        groupFrom(tenTiles(), 0, kCellsOfTen, goalToLeave(kCellsOfTen - left, true), kAlike);
    EXPECT_EQ(group.end, 1u) << left;
    EXPECT_EQ(group.share, 1) << left;
  }
}

TEST(TileGroups, ShareNothingTowardsOtherGoals) {
  const TileGroup group = groupFrom(tenTiles(), 0, kCellsOfTen, goalToLeave(8000, false), kAlike);
  EXPECT_EQ(group.end, 1u);
  EXPECT_EQ(group.share, 1);
}

TEST(TileGroups, ShareAsMuchAsIsAsked) {
  const TileGroup group = groupFrom(tenTiles(), 0, kCellsOfTen, goalToLeave(7000, false), 0.6);
  EXPECT_EQ(group.end, 5u);
  EXPECT_DOUBLE_EQ(group.share, 0.6);
}

}  // namespace
}  // namespace tetstream::test
