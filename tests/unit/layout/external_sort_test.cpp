// Records come back in the order of their keys, equal ones as they came, whatever fits the memory.
#include "external_sort.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cstring>
#include <numeric>

#include "random.h"
#include "status.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

void expectSorted(const std::vector<uint64_t>& keys, size_t payload_bytes, size_t memory) {
  Account account;
  ExternalSort sort(payload_bytes, memory, account, "");
  for (uint64_t i = 0; i < keys.size(); ++i) {
    unsigned char* payload = sort.add(keys[i]);
    std::memset(payload, static_cast<int>(i % 251), payload_bytes);
    std::memcpy(payload, &i, sizeof i);
  }
  sort.finish();
  std::vector<uint64_t> order(keys.size());
  std::iota(order.begin(), order.end(), uint64_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](uint64_t a, uint64_t b) { return keys[a] < keys[b]; });
  uint64_t key;
  for (uint64_t i : order) {
    const unsigned char* payload = sort.next(&key);
    ASSERT_NE(payload, nullptr);
    ASSERT_EQ(key, keys[i]);
    ASSERT_EQ(0, std::memcmp(payload, &i, sizeof i));
    for (size_t k = sizeof i; k < payload_bytes; ++k) ASSERT_EQ(payload[k], i % 251);
  }
  EXPECT_EQ(sort.next(&key), nullptr);
  EXPECT_EQ(sort.next(&key), nullptr);
  const bool fits = keys.size() * (payload_bytes + 32) <= memory / 3 * 2;
  EXPECT_EQ(sort.diskBytes() == 0, fits);
}

std::vector<uint64_t> keysOf(size_t count, uint64_t mask) {
  Random random(7);
  std::vector<uint64_t> keys(count);
  for (uint64_t& key : keys) {
    key = uint64_t{random.below(1u << 31)} << 33 ^ uint64_t { random.below(1u << 31) } << 11 ^
          random.below(1u << 11);
    key &= mask;
  }
  return keys;
}

TEST(ExternalSort, SortsInMemoryAndInRuns) {
  const size_t count = slowRun() ? 5000 : 40000;
  for (uint64_t mask : {~uint64_t{0}, uint64_t{0xff00000000000000}, uint64_t{7}, uint64_t{0}})
    for (size_t memory : {size_t{1} << 24, size_t{1} << 18}) {
      SCOPED_TRACE(mask);
      expectSorted(keysOf(count, mask), 24, memory);
    }
}

// More runs than are merged at once: in two levels.
TEST(ExternalSort, MergesInLevels) {
  expectSorted(keysOf(1024 * 70, 0xffff), 8, 1);
}

TEST(ExternalSort, SortsNothingAndOne) {
  expectSorted({}, 8, 1 << 16);
  expectSorted({42}, 8, 1 << 16);
}

TEST(ExternalSort, SortsKeysAlone) {
  for (size_t memory : {size_t{1} << 24, size_t{1}}) {
    Account account;
    ExternalSort sort(0, memory, account, "");
    std::vector<uint64_t> keys = keysOf(3000, 0xff);
    for (uint64_t key : keys) sort.add(key);
    sort.finish();
    std::sort(keys.begin(), keys.end());
    uint64_t key;
    for (uint64_t wanted : keys) {
      ASSERT_NE(sort.next(&key), nullptr);
      ASSERT_EQ(key, wanted);
    }
    EXPECT_EQ(sort.next(&key), nullptr);
  }
}

TEST(ExternalSort, KeepsWithinItsMemory) {
  const size_t memory = 1 << 18;
  Account account;
  ExternalSort sort(24, memory, account, "");
  for (uint64_t key : keysOf(20000, ~uint64_t{0})) std::memset(sort.add(key), 0, 24);
  sort.finish();
  EXPECT_LE(account.peak(), memory + memory / 8);
}

TEST(ExternalSort, NamesThePlaceWhereItCannotWrite) {
  Account account;
  ExternalSort sort(8, 1, account, "/nowhere");
  try {
    for (uint64_t key = 0; key < 1 << 20; ++key) std::memset(sort.add(key), 0, 8);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kIo);
    EXPECT_NE(std::string(error.text()).find("/nowhere"), std::string::npos);
  }
}

}  // namespace
}  // namespace tetstream::test
