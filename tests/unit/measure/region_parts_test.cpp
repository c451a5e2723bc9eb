// Regions of many labels: all of them count, unless they are the cells' ids.
#include "region_parts.h"

#include <gtest/gtest.h>

#include "mix.h"
#include "status.h"

namespace tetstream::test {
namespace {

// Cells one after the other, `each` of them to a label, joined to the one before.
void addCells(RegionParts& parts, int64_t count, int64_t each) {
  for (int64_t c = 0; c < count; ++c) {
    const auto number = static_cast<uint32_t>(c % 2);
    if (c > 1) parts.remove(number);
    parts.add(number, c / each, 0.5);
    if (c > 0) parts.join(number, 1 - number);
  }
}

TEST(RegionParts, CountAsManyLabelsAsThereAre) {
  Account account;
  {
    RegionParts parts(account, true);
    addCells(parts, 300000, 3);
    EXPECT_FALSE(parts.dropped());
    ASSERT_EQ(parts.regions().size(), 100000u);
    for (const auto& [label, figures] : parts.regions()) {
      ASSERT_EQ(figures.cells, 3);
      ASSERT_EQ(figures.parts, 1);
      ASSERT_EQ(figures.volume, 1.5);
    }
    EXPECT_GT(account.used(), 100000 * sizeof(RegionFigures));
  }
  EXPECT_EQ(account.used(), 0u);
}

TEST(RegionParts, LeaveIdsOutUnlessTheyAreAskedFor) {
  Account account;
  RegionParts ids(account, true), wished(account, false);
  addCells(ids, 5000, 1);
  addCells(wished, 5000, 1);
  EXPECT_TRUE(ids.dropped());
  EXPECT_TRUE(ids.regions().empty());
  EXPECT_FALSE(wished.dropped());
  EXPECT_EQ(wished.regions().size(), 5000u);
}

// Thousands of labels, of which the first thousand cells have nearly as many.
TEST(RegionParts, AreNoIdsInWhateverOrderCellsCome) {
  Account account;
  RegionParts shuffled(account, true);
  for (int64_t c = 0; c < 60000; ++c) {
    const auto number = static_cast<uint32_t>(c % 2);
    if (c > 1) shuffled.remove(number);
    shuffled.add(number, static_cast<int64_t>(mix(static_cast<uint64_t>(c) + 1) % 3000), 1);
  }
  EXPECT_FALSE(shuffled.dropped());
  EXPECT_EQ(shuffled.regions().size(), 3000u);
}

TEST(RegionParts, StayWithinTheirAccount) {
  Account account(size_t{1} << 20);
  RegionParts parts(account, false);
  try {
    addCells(parts, 1000000, 1);
    FAIL() << "a million labels in a megabyte";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kNoMemory);
  }
  EXPECT_GT(parts.regions().size(), 2000u);
}

}  // namespace
}  // namespace tetstream::test
