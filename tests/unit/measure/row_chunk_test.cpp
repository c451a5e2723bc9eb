// Rows in chunks: all of them once, in order, found by their place, within the bytes.
#include "row_chunk.h"

#include <gtest/gtest.h>
#include <algorithm>

#include "cells_testing.h"

namespace tetstream::test {
namespace {

constexpr size_t kTriangles = 700;

std::unique_ptr<SimplexRows> triangles(Account& account, size_t in_core_bytes) {
  Random random(1);
  std::vector<std::vector<double>> all;
  for (size_t i = 0; i < kTriangles; ++i) all.push_back(randomSimplex(random, 3, 0.1));
  return rowsOf(
      all, {3, 1}, [](const double* at) { return std::vector{at[0] + at[1]}; }, account,
      in_core_bytes);
}

TEST(RowChunk, HasEachRowOnceInOrderAndByItsPlace) {
  Account account;
  for (size_t in_core : {1000, 1 << 20})
    for (size_t bytes : {1, 5000, 50000, 1 << 20}) {
      const auto rows = triangles(account, in_core);
      ASSERT_EQ(rows->inCore() != nullptr, in_core > 1000);
      uint64_t next = 0;
      size_t chunks = 0;
      forEachChunk(*rows, bytes, 0, account, [&](const RowChunk& chunk) {
        ++chunks;
        for (size_t i = 0; i < chunk.count(); ++i) {
          const double* row = chunk.row(i);
          ASSERT_TRUE(std::equal(row, row + chunk.shape().doubles(), rows->row(next++)));
          bool found = false;
          chunk.tree().forEachNear(chunk.shape().boxOf(row), [&](uint32_t n) { found |= n == i; });
          ASSERT_TRUE(found);
        }
      });
      EXPECT_EQ(next, kTriangles);
      const size_t most = RowChunk::rowsFor(*rows, bytes, 0);
      EXPECT_EQ(chunks, (kTriangles + most - 1) / most);
    }
}

TEST(RowChunk, TakesNoMoreThanItsBytes) {
  for (size_t in_core : {1000, 1 << 20}) {
    Account held;
    const auto rows = triangles(held, in_core);
    for (size_t bytes : {1000, 20000, 100000}) {
      Account account(bytes);  // which throws where more is taken
      forEachChunk(*rows, bytes, 0, account, [](const RowChunk&) {});
      EXPECT_GT(account.peak(), bytes / 4);
      EXPECT_EQ(account.used(), 0u);
    }
  }
}

TEST(RowChunk, LeavesBytesForWhatItsUserAdds) {
  Account account;
  const auto rows = triangles(account, 1 << 20);
  const size_t alone = RowChunk::rowsFor(*rows, 1 << 20, 0);
  const size_t beside = RowChunk::rowsFor(*rows, 1 << 20, 1000);
  EXPECT_LE(beside * 1000, size_t{1} << 20);
  EXPECT_LT(beside, alone);
  EXPECT_EQ(RowChunk::rowsFor(*rows, 0, 0), 1u);
}

TEST(RowChunk, OfNoRowsThereIsNone) {
  Account account;
  const auto none = rowsOf({}, {3, 0}, noValues, account);
  forEachChunk(*none, 1000, 0, account, [](const RowChunk&) { ADD_FAILURE() << "a chunk"; });
}

}  // namespace
}  // namespace tetstream::test
