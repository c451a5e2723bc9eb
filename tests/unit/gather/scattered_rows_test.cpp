// Rows put in any order come back in sequence, those that never came as zeros.
#include "scattered_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace tetstream {
namespace {

struct ScatteredRow {
  uint64_t number = 0;
  uint32_t more[3] = {0, 0, 0};
  uint32_t last = 0;
  bool operator==(const ScatteredRow&) const = default;
};

ScatteredRow scatteredRow(uint64_t number) {
  const auto n = static_cast<uint32_t>(number);
  return {number + 1, {n, n + 1, n + 2}, ~n};
}

// Puts rows of those numbers, in that order, and looks at all.
void expectScattered(const std::vector<uint64_t>& order, uint64_t count) {
  ScatteredRows rows(sizeof(ScatteredRow), "");
  std::vector<ScatteredRow> expected(static_cast<size_t>(count)), found(expected.size());
  uint64_t times = 0, given = 0;
  for (uint64_t row : order) {
    ScatteredRow& to = expected[static_cast<size_t>(row)];
    given += to == ScatteredRow();
    to = scatteredRow(row + 1000 * times++);
    rows.put(row, &to);
    ASSERT_EQ(rows.given(), given);
  }
  rows.finish(count);
  EXPECT_EQ(rows.given(), given);
  for (uint64_t first = 0; first < count; first += 1000) {
    const auto some = static_cast<size_t>(std::min<uint64_t>(1000, count - first));
    rows.read(first, some, found.data() + first);
  }
  EXPECT_TRUE(found == expected);
}

std::vector<uint64_t> inSequence(uint64_t count) {
  std::vector<uint64_t> order(static_cast<size_t>(count));
  std::iota(order.begin(), order.end(), uint64_t{0});
  return order;
}

TEST(ScatteredRows, ComeInAnyOrder) {
  std::vector<uint64_t> order = inSequence(20000);  // some runs are longer than is held
  expectScattered(order, order.size());
  std::rotate(order.begin(), order.begin() + 7000, order.end());
  expectScattered(order, order.size());
  std::reverse(order.begin(), order.end());
  expectScattered(order, order.size());
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  expectScattered(order, order.size());
}

TEST(ScatteredRows, ThatNeverComeAreZero) {
  expectScattered({}, 0);
  expectScattered({}, 5000);
  expectScattered({4000}, 5000);
  expectScattered({0, 1, 2, 4999}, 5000);
  expectScattered({3, 4, 7, 8, 6, 100, 99}, 5000);
  std::vector<uint64_t> order = inSequence(20000);
  std::shuffle(order.begin(), order.end(), std::mt19937(2));
  order.resize(5000);
  expectScattered(order, 20000);
}

TEST(ScatteredRows, ThatComeAgainCountOnceAndTheLastOneStays) {
  expectScattered({0, 0}, 1);
  expectScattered({0, 1, 2, 1, 2, 3, 0}, 4);
  expectScattered({5, 6, 5, 6, 7, 0}, 10);
  std::vector<uint64_t> order;
  std::mt19937 random(3);
  for (int n = 0; n < 20000; ++n) order.push_back(random() % 5000);
  expectScattered(order, 5000);
}

TEST(ScatteredRows, KnowTheirSize) {
  EXPECT_EQ(ScatteredRows(24, "").rowBytes(), 24u);
  EXPECT_EQ(ScatteredRows(24, "").given(), 0u);
}

}  // namespace
}  // namespace tetstream
