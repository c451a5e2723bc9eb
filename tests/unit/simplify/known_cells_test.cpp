// One thread follows another through the cells, and is never ahead of it.
#include "known_cells.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace tetstream::test {
namespace {

TEST(KnownCells, AreTheFirstOnesAtOnce) {
  KnownCells known(7);
  EXPECT_EQ(known.waitFor(0), 7u);
  EXPECT_EQ(known.waitFor(6), 7u);
}

TEST(KnownCells, LetAThreadWaitForTheOthers) {
  constexpr uint32_t kEnd = 5000, kStep = 10;
  std::vector<uint32_t> cells(kEnd, 0);
  KnownCells known(0);
  std::thread first([&] {
    for (uint32_t c = 0; c < kEnd; ++c) {
      cells[c] = c + 1;
      if ((c + 1) % kStep == 0) known.tell(c + 1);
    }
  });
  for (uint32_t c = 0, next; c < kEnd; c = next) {
    next = known.waitFor(c);
    EXPECT_GT(next, c);
    for (uint32_t k = c; k < next; ++k) EXPECT_EQ(cells[k], k + 1);
  }
  first.join();
}

}  // namespace
}  // namespace tetstream::test
