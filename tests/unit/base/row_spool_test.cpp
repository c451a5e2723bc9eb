// Rows come back as they were written, in any order, from memory or from a file.
#include "row_spool.h"

#include <gtest/gtest.h>
#include <unistd.h>
#include <cstring>

#include "random.h"
#include "status.h"

namespace tetstream::test {
namespace {

struct Row {
  uint64_t number;
  uint32_t more[4];  // no padding
};

void fill(RowSpool& spool, uint64_t rows) {
  for (uint64_t i = 0; i < rows; ++i) {
    const auto n = static_cast<uint32_t>(i);
    const Row row = {i, {n, n + 1, n + 2, n + 3}};
    spool.append(&row, 1);
  }
  spool.finish();
}

void expectRow(RowSpool& spool, uint64_t index) {
  Row row;
  std::memcpy(&row, spool.row(index), sizeof row);
  EXPECT_EQ(row.number, index);
  EXPECT_EQ(row.more[2], static_cast<uint32_t>(index) + 2);
}

TEST(RowSpool, GivesRowsInAnyOrder) {
  for (uint64_t rows : {1, 31, 32, 33, 1000}) {
    RowSpool spool(sizeof(Row), "", {2, 800});  // 32 rows in a block
    fill(spool, rows);
    EXPECT_EQ(spool.rows(), rows);
    EXPECT_EQ(spool.diskBytes() > 0, rows > 64);
    for (uint64_t i = 0; i < rows; ++i) expectRow(spool, i);
    for (uint64_t i = rows; i-- > 0;) expectRow(spool, i);
    Random random(3);
    for (int k = 0; k < 500; ++k) expectRow(spool, random.below(static_cast<uint32_t>(rows)));
  }
}

TEST(RowSpool, HoldsRowsLargerThanABlock) {
  RowSpool spool(sizeof(Row), "", {1, 5});
  fill(spool, 50);
  for (uint64_t i = 0; i < 50; ++i) expectRow(spool, i);
}

}  // namespace
}  // namespace tetstream::test
