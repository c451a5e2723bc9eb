// A set of points against one of the standard library.
#include "point_set.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace tetstream {
namespace {

TEST(PointSet, TellsWhatIsInIt) {
  std::mt19937 random(1);
  for (uint64_t points : {1, 63, 64, 65, 128, 1000}) {
    Account account;
    PointSet set(account, points);
    std::set<uint64_t> expected;
    for (uint64_t n = 0; n < 10 * points; ++n) {
      const uint64_t point = random() % points;
      if (random() % 3)
        ASSERT_EQ(set.add(point), expected.insert(point).second);
      else
        ASSERT_EQ(set.remove(point), expected.erase(point) == 1);
    }
    for (uint64_t point = 0; point < points; ++point)
      ASSERT_EQ(set.has(point), expected.count(point) == 1) << point << " of " << points;
  }
}

TEST(PointSet, IsEmptyAtFirst) {
  Account account;
  const PointSet set(account, 1000);
  for (uint64_t point = 0; point < 1000; ++point) ASSERT_FALSE(set.has(point));
}

TEST(PointSet, TakesABitOfEachPoint) {
  Account account;
  {
    const PointSet set(account, 1000000);
    EXPECT_GE(account.used(), 1000000u / 8);
    EXPECT_LE(account.used(), 1000000u / 8 + 8);
  }
  EXPECT_EQ(account.used(), 0u);
}

}  // namespace
}  // namespace tetstream
