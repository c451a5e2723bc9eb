// Rows come back as they were added, from memory or from a file, and within what they may take.
#include "simplex_rows.h"

#include <gtest/gtest.h>
#include <algorithm>

#include "cells_testing.h"

namespace tetstream::test {
namespace {

constexpr RowShape kTwoValues = {3, 2};

std::vector<double> numbered(size_t number) {
  std::vector<double> row(kTwoValues.doubles());
  for (size_t k = 0; k < row.size(); ++k) row[k] = static_cast<double>(100 * number + k);
  return row;
}

TEST(SimplexRows, ComeBackInAnyOrderFromMemoryOrAFile) {
  constexpr size_t kRows = 2000, kRowBytes = 3 * 5 * sizeof(double), kBytes = kRows * kRowBytes;
  for (size_t limit : {size_t{1}, size_t{100000}, kBytes - 1, kBytes, 2 * kBytes}) {
    Account account;
    SimplexRows rows(kTwoValues, {account, "", limit});
    for (size_t i = 0; i < kRows; ++i) rows.add(numbered(i).data());
    rows.finish();
    EXPECT_EQ(rows.count(), kRows);
    EXPECT_EQ(rows.bytes(), kBytes);
    EXPECT_EQ(rows.inCore() != nullptr, limit >= kBytes) << limit;
    EXPECT_LE(account.peak(), std::max(limit, kRowBytes));
    Random random(1);
    for (size_t n = 0; n < kRows; ++n) {
      const size_t i = n % 2 ? n : random.below(kRows);
      const std::vector<double> expected = numbered(i);
      ASSERT_TRUE(std::equal(expected.begin(), expected.end(), rows.row(i))) << i;
    }
  }
}

TEST(SimplexRows, AreAllInCoreOneAfterTheOther) {
  Account account;
  SimplexRows rows(kTwoValues, {account, "", 1 << 20});
  for (size_t i = 0; i < 1000; ++i) rows.add(numbered(i).data());
  rows.finish();
  ASSERT_NE(rows.inCore(), nullptr);
  for (size_t i = 0; i < 1000; ++i) {
    const std::vector<double> expected = numbered(i);
    ASSERT_TRUE(
        std::equal(expected.begin(), expected.end(), rows.inCore() + i * kTwoValues.doubles()));
  }
}

TEST(SimplexRows, HaveTheBoxesOfTheirCornersAndOfTheirCentres) {
  Account account;
  const auto rows = rowsOf({{0, 0, 0, 3, 0, 0, 0, 6, 0}, {0, 0, -3, 0, -3, 0, 9, 0, 0}}, {3, 0},
                           noValues, account);
  const Box &all = rows->box(), &centres = rows->centres();
  const double low[3] = {0, -3, -3}, high[3] = {9, 6, 0};
  const double first[3] = {1, -1, -1}, last[3] = {3, 2, 0};
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(all.low[k], low[k]);
    EXPECT_EQ(all.high[k], high[k]);
    EXPECT_DOUBLE_EQ(centres.low[k], first[k]);
    EXPECT_DOUBLE_EQ(centres.high[k], last[k]);
  }
}

TEST(SimplexRows, AreThePlacesOfCornersThenTheirValues) {
  const std::vector<double> row = numbered(0);
  EXPECT_EQ(kTwoValues.place(row.data(), 2)[0], 6);
  EXPECT_EQ(kTwoValues.value(row.data(), 0)[0], 9);
  EXPECT_EQ(kTwoValues.value(row.data(), 2)[1], 14);
}

TEST(Box, OfNothingMeetsNothingAndAddsNothing) {
  const Box nothing;
  Box box;
  const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
  box.add(low);
  box.add(high);
  EXPECT_FALSE(nothing.meets(box));
  EXPECT_FALSE(box.meets(nothing));
  EXPECT_FALSE(nothing.meets(nothing));
  box.add(nothing);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(box.low[k], 0);
    EXPECT_EQ(box.high[k], 1);
  }
}

TEST(Box, MeetsThoseThatItTouches) {
  for (int k = 0; k < 3; ++k)
    for (double side : {-1.0, 1.0}) {
      Box box, other, apart;
      const double low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
      for (const double* corner : {low, high}) {
        double beside[3] = {corner[0], corner[1], corner[2]};
        box.add(corner);
        beside[k] += side;
        other.add(beside);
        beside[k] += side / 1024;
        apart.add(beside);
      }
      EXPECT_TRUE(box.meets(other) && other.meets(box));
      EXPECT_FALSE(box.meets(apart) || apart.meets(box));
    }
}

}  // namespace
}  // namespace tetstream::test
