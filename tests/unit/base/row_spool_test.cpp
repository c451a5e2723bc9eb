// Rows come back as they were written, in any order, from memory or from a file.
#include "row_spool.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "random.h"
#include "status.h"
#include "strange_workers.h"

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

// Whoever writes: threads of our own, others that refuse, that work at once, or too late.
TEST(RowSpool, GivesTheSameRowsWhereOthersWrite) {
  NoWorkers none;
  HastyWorkers hasty;
  LazyWorkers lazy;
  for (Workers* workers : std::initializer_list<Workers*>{nullptr, &none, &hasty, &lazy}) {
    const Tasks tasks(3, workers);
    for (uint64_t rows : {1, 64, 65, 1000, 20000}) {
      RowSpool spool(sizeof(Row), "", {2, 800}, &tasks);
      fill(spool, rows);
      EXPECT_EQ(spool.diskBytes(), [&] {
        RowSpool alone(sizeof(Row), "", {2, 800});
        fill(alone, rows);
        return alone.diskBytes();
      }());
      for (uint64_t i = 0; i < rows; ++i) expectRow(spool, i);
    }
    RowSpool given_up(sizeof(Row), "", {2, 800}, &tasks);
    const Row row = {};
    for (int i = 0; i < 500; ++i) given_up.append(&row, 1);
  }
  lazy.workAll();  // too late
}

// What cannot be written is told, however late.
TEST(RowSpool, TellsThatOthersFailedToWrite) {
  const Tasks tasks(2);
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {10000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(
      {
        RowSpool spool(sizeof(Row), "", {2, 800}, &tasks);
        fill(spool, 1000);
      },
      Error);
  ::setrlimit(RLIMIT_FSIZE, &before);
  ::signal(SIGXFSZ, handler);
}

TEST(RowSpool, HoldsRowsLargerThanABlock) {
  RowSpool spool(sizeof(Row), "", {1, 5});
  fill(spool, 50);
  for (uint64_t i = 0; i < 50; ++i) expectRow(spool, i);
}

}  // namespace
}  // namespace tetstream::test
