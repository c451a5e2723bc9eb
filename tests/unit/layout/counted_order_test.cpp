// Records in the order of small keys. That the stream is the same as that of sorted records is for
// ordered_source_test.cpp.
#include "counted_order.h"

#include <gtest/gtest.h>

#include <vector>

namespace tetstream::test {
namespace {

TEST(CountedOrder, IsByKeysAndThenAsRecordsCame) {
  const std::vector<uint32_t> keys = {5, 4, 5, 3, 0, 5, 4};
  Account account;
  CountedOrder order(keys.size(), 7, account);
  for (uint32_t key : keys) order.count(key);
  order.beginPutting();
  for (uint32_t i = 0; i < keys.size(); ++i) order.put(keys[i], i);
  std::vector<uint32_t> found;
  for (size_t place = 0; place < order.size(); ++place) found.push_back(order[place]);
  EXPECT_EQ(found, (std::vector<uint32_t>{4, 3, 1, 6, 0, 2, 5}));
}

TEST(CountedOrder, TakesFourBytesARecordAndFourAKey) {
  Account account;
  const CountedOrder order(1000, 170, account);
  EXPECT_EQ(account.peak(), 4u * (1000 + 170));
  EXPECT_EQ(CountedOrder::bytesFor(1000, 170), account.peak());
}

TEST(CountedOrder, OfNothingIsEmpty) {
  Account account;
  CountedOrder order(0, 0, account);
  order.beginPutting();
  EXPECT_EQ(order.size(), 0u);
}

}  // namespace
}  // namespace tetstream::test
