// Points that follow the cells that they lie in: through a flip of three cells to two, out of the
// mesh and back, and in little memory.
#include "traced_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "status.h"

namespace tetstream::test {
namespace {

using Place = std::array<double, 3>;

PlacedCell placed(uint32_t cell, const Place& a, const Place& b, const Place& c, const Place& d) {
  PlacedCell out{cell, {}};
  const Place* const corners[4] = {&a, &b, &c, &d};
  for (int k = 0; k < 4; ++k) std::copy_n(corners[k]->begin(), 3, out.corner[k]);
  return out;
}

struct Cells {
  Account account;
  TracedPoints<double> points{account};
  std::vector<uint32_t> first = std::vector<uint32_t>(8, kNone);

  void add(int64_t id, const Place& x) { points.add(id, x.data()); }
  void reshape(const std::vector<uint32_t>& before, const std::vector<PlacedCell>& after) {
    points.reshaped(first.data(), before.data(), before.size(), after.data(), after.size());
  }
  std::vector<int64_t> take(uint32_t cell) {
    std::vector<int64_t> ids;
    points.take(first[cell], [&](int64_t id, const double*) { ids.push_back(id); });
    std::sort(ids.begin(), ids.end());
    return ids;
  }
};

// Top and bottom over a triangle: two cells that share it, or three round the line between them.
const Place kA = {0, 0, 0}, kB = {1, 0, 0}, kC = {0, 1, 0}, kTop = {0.25, 0.25, 1},
            kBottom = {0.25, 0.25, -1};
const std::vector<PlacedCell> kTwo = {placed(0, kA, kB, kC, kTop), placed(1, kA, kC, kB, kBottom)};
const std::vector<PlacedCell> kThree = {placed(0, kTop, kA, kB, kBottom),
                                        placed(1, kTop, kB, kC, kBottom),
                                        placed(2, kTop, kC, kA, kBottom)};

TEST(TracedPoints, GoToTheCellsThatTheyLieIn) {
  Cells cells;
  cells.add(10, {0.1, 0.25, 0.1});
  cells.add(11, {0.1, 0.25, -0.1});
  cells.add(12, {0.3, 0.1, 0.2});
  cells.reshape({}, kTwo);
  EXPECT_EQ(cells.points.count(), 3u);
  cells.reshape({0, 1}, kThree);
  EXPECT_EQ(cells.take(0), (std::vector<int64_t>{12}));
  EXPECT_EQ(cells.take(1), (std::vector<int64_t>{}));
  EXPECT_EQ(cells.take(2), (std::vector<int64_t>{10, 11}));
  EXPECT_EQ(cells.points.count(), 0u);
}

TEST(TracedPoints, FlippedThereAndBackAreWhereTheyWere) {
  Cells cells;
  for (int i = 0; i < 60; ++i) cells.add(i, {0.01 * i, 0.3 - 0.005 * i, i % 2 ? 0.05 : -0.05});
  cells.reshape({}, kTwo);
  cells.reshape({0, 1}, kThree);
  cells.reshape({0, 1, 2}, kTwo);
  std::vector<int64_t> odd, even;
  for (int i = 0; i < 60; ++i) (i % 2 ? odd : even).push_back(i);
  EXPECT_EQ(cells.take(0), odd);
  EXPECT_EQ(cells.take(1), even);
  EXPECT_EQ(cells.first[2], kNone);
}

TEST(TracedPoints, OutsideGoToTheCellThatIsNearestByItsWeights) {
  Cells cells;
  cells.add(1, {0.25, 0.25, 3});
  cells.add(2, {0.25, 0.25, -3});
  cells.reshape({}, kTwo);
  EXPECT_EQ(cells.take(0), (std::vector<int64_t>{1}));
  EXPECT_EQ(cells.take(1), (std::vector<int64_t>{2}));
}

TEST(TracedPoints, OfCellsThatStayAreLeftAlone) {
  Cells cells;
  cells.add(1, {0.2, 0.2, 0.1});
  cells.reshape({}, kTwo);
  cells.add(2, {0.2, 0.2, 0.2});
  cells.reshape({1}, {placed(3, kA, kB, kC, kTop)});
  EXPECT_EQ(cells.take(0), (std::vector<int64_t>{1}));
  EXPECT_EQ(cells.take(3), (std::vector<int64_t>{2}));
}

TEST(TracedPoints, TakeTheRoomOfThoseThatWereTaken) {
  Cells cells;
  size_t peak = 0;
  for (int round = 0; round < 50; ++round) {
    for (int i = 0; i < 1000; ++i) cells.add(i, {0.2, 0.2, 0.1});
    cells.reshape({}, kTwo);
    EXPECT_EQ(cells.take(0).size(), 1000u);
    if (round == 0) peak = cells.account.peak();
  }
  EXPECT_EQ(cells.account.peak(), peak);
}

TEST(TracedPoints, KeepToTheirBudget) {
  Account account(100 << 10);
  TracedPoints<double> points(account);
  const double x[3] = {0.2, 0.2, 0.1};
  size_t room = 0;
  EXPECT_THROW(for (;; ++room) points.add(1, x);, Error);
  EXPECT_EQ(points.count(), room);
  EXPECT_GT(room * sizeof(TracedPoints<double>::Point), size_t{90} << 10);
}

}  // namespace
}  // namespace tetstream::test
