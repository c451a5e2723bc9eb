// Accounts and arrays: limits hold, peaks are told, contents outlive growth.
#include "memory.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

#include "random.h"
#include "scalar.h"
#include "status.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

constexpr size_t kMost = std::numeric_limits<size_t>::max();

template <class Action>
Status statusOf(Action action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_FALSE(error.text().empty());
    return error.status();
  }
  return Status::kOk;
}

TEST(CheckedSizes, ThrowWhereTheyDoNotFit) {
  EXPECT_EQ(checkedMultiply(7, 6), 42u);
  EXPECT_EQ(checkedMultiply(0, kMost), 0u);
  EXPECT_EQ(checkedMultiply(kMost, 1), kMost);
  EXPECT_EQ(checkedAdd(kMost - 1, 1), kMost);
  EXPECT_EQ(statusOf([] { checkedMultiply(kMost / 2 + 1, 2); }), Status::kNoMemory);
  EXPECT_EQ(statusOf([] { checkedMultiply(size_t{1} << 32, size_t{1} << 32); }), Status::kNoMemory);
  EXPECT_EQ(statusOf([] { checkedAdd(kMost, 1); }), Status::kNoMemory);
}

TEST(Account, HoldsItsLimitToTheByte) {
  Account account(100);
  account.charge(60);
  account.charge(40);
  EXPECT_FALSE(account.refused());
  EXPECT_EQ(statusOf([&] { account.charge(1); }), Status::kNoMemory);
  EXPECT_TRUE(account.refused());
  EXPECT_EQ(account.used(), 100u);  // what failed had no effect
  account.release(30);
  account.charge(29);
  EXPECT_EQ(account.used(), 99u);
  EXPECT_EQ(account.peak(), 100u);
  EXPECT_EQ(account.limit(), 100u);
  EXPECT_EQ(statusOf([&] { account.charge(kMost); }), Status::kNoMemory);
}

TEST(Account, OfAShareSpeaksOfTheBudget) {
  Account account(1000, 0.75);
  EXPECT_EQ(account.limit(), 750u);
  account.charge(700);
  try {
    account.charge(800);
    FAIL() << "twice the budget";
  } catch (const Error& error) {
    EXPECT_EQ(error.text(),
              "the memory budget of 1000 bytes is too small: at least 2000 are needed");
  }
  EXPECT_TRUE(account.refused());
  EXPECT_EQ(Account(0, 0.75).limit(), 0u);
}

TEST(Account, WithoutALimitTakesAnything) {
  Account account;
  account.charge(kMost);
  EXPECT_EQ(account.peak(), kMost);
  EXPECT_EQ(statusOf([&] { account.charge(1); }), Status::kNoMemory);
}

TEST(Array, KeepsItsContentsWhileItGrowsAndShrinks) {
  Account account;
  {
    Array<uint64_t> array(account);
    EXPECT_EQ(array.size(), 0u);
    Random r(1);
    size_t filled = 0;
    for (size_t size : {1, 2, 3, 1000, 1001, 100000, 50000, 7, 7, 90000}) {
      array.resize(size);
      EXPECT_EQ(account.used(), size * 8);
      for (size_t i = 0; i < std::min(filled, size); ++i) ASSERT_EQ(array[i], i * i);
      for (size_t i = 0; i < size; ++i) array[i] = i * i;
      filled = size;
    }
    EXPECT_EQ(account.peak(), 800000u);
    array.resize(0);
    EXPECT_EQ(account.used(), 0u);
    array.resize(5);
  }
  EXPECT_EQ(account.used(), 0u);
}

// As large as those that lie on large pages.
TEST(Array, KeepsItsContentsBeyondMegabytes) {
  for (const size_t limit : {size_t{0}, size_t{1} << 30}) {
    Account account(limit);
    Array<uint32_t> array(account, 1000);
    for (uint32_t i = 0; i < 1000; ++i) array[i] = i * i;
    for (size_t megabytes : {3, 4, 5, 17, 40, 9, 1}) {
      array.resize(megabytes << 18);
      array[array.size() - 1] = 7;
      for (uint32_t i = 0; i < 1000; ++i) ASSERT_EQ(array[i], i * i);
    }
    EXPECT_EQ(account.used(), size_t{1} << 20);
  }
}

TEST(Array, StaysAsItIsWhereItCannotGrow) {
  Account account(1000);
  Array<uint32_t> array(account, 100);
  array[99] = 7;
  EXPECT_EQ(statusOf([&] { array.resize(251); }), Status::kNoMemory);
  EXPECT_EQ(statusOf([&] { array.resize(kMost / 4 + 1); }), Status::kNoMemory);
  EXPECT_EQ(statusOf([&] { array.resize(kMost / 4); }), Status::kNoMemory);
  EXPECT_EQ(array.size(), 100u);
  EXPECT_EQ(array[99], 7u);
  EXPECT_EQ(account.used(), 400u);
  array.resize(250);
  EXPECT_EQ(account.used(), 1000u);
}

TEST(GrowArray, TakesASmallStepWhereABudgetAllowsNoLargeOne) {
  Account account(1200);
  Array<char> array(account, 1000);
  const auto grow = [&](size_t more) {
    growArray(array.size(), more, [&](size_t size) { array.resize(size); });
  };
  grow(100);
  EXPECT_EQ(array.size(), 1100u);
  grow(800);  // 51 are left to be had
  EXPECT_EQ(array.size(), 1151u);
  grow(1);
  EXPECT_EQ(array.size(), 1152u);
  EXPECT_EQ(statusOf([&] { grow(800); }), Status::kNoMemory);
  EXPECT_EQ(array.size(), 1152u);
  EXPECT_EQ(statusOf([&] { growArray(kMost, 5, [](size_t) {}); }), Status::kNoMemory);
}

// What stops a run for another reason is no matter of memory.
TEST(GrowArray, PassesOtherErrorsOn) {
  int calls = 0;
  const auto refuse = [&](size_t) {
    ++calls;
    fail(Status::kBadData, "no");
  };
  EXPECT_EQ(statusOf([&] { growArray(10, 5, refuse); }), Status::kBadData);
  EXPECT_EQ(calls, 1);
}

// More than any machine has: the system's refusal, not the account's. Checkers take such a size for
// a mistake.
#ifndef __SANITIZE_ADDRESS__
TEST(Array, SaysWhenTheSystemHasNoMemory) {
  if (slowRun()) return;
  Account account(size_t{1} << 63);
  EXPECT_EQ(statusOf([&] { account.charge(~size_t{0} - 100); }), Status::kNoMemory);
  EXPECT_TRUE(account.refused());
  Array<char> array(account, 10);
  EXPECT_EQ(statusOf([&] { array.resize(size_t{1} << 62); }), Status::kNoMemory);
  EXPECT_FALSE(account.refused());
  EXPECT_EQ(account.used(), 10u);
  EXPECT_EQ(array.size(), 10u);
}
#endif

// Of the whole pages of the bytes [first, end), those that are in memory.
size_t residentPages(const Array<char>& array, size_t first, size_t end) {
  const auto page = static_cast<uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto data = reinterpret_cast<uintptr_t>(array.data());
  const uintptr_t from = (data + first + page - 1) / page * page, to = (data + end) / page * page;
  std::vector<unsigned char> states((to - from) / page);
  EXPECT_EQ(mincore(reinterpret_cast<void*>(from), to - from, states.data()), 0);
  return static_cast<size_t>(
      std::count_if(states.begin(), states.end(), [](unsigned char s) { return s & 1; }));
}

bool pagesComeAtOnce() {
#ifdef MADV_POPULATE_WRITE
  void* const page = mmap(nullptr, 1, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const bool known = madvise(page, 1, MADV_POPULATE_WRITE) == 0;
  munmap(page, 1);
  return known;
#else
  return false;
#endif
}

// Of less than what lies on large pages.
constexpr size_t kExpected = size_t{1} << 20;

TEST(Array, HasThePagesOfWhatIsExpected) {
  Account account;
  Array<char> array(account, 3 * kExpected);
  array[0] = 'a';
  const size_t beyond = residentPages(array, kExpected, 3 * kExpected);
  array.expect(0, kExpected);
  EXPECT_EQ(array[0], 'a');
  EXPECT_EQ(residentPages(array, kExpected, 3 * kExpected), beyond);
  const size_t wanted = kExpected / static_cast<size_t>(sysconf(_SC_PAGESIZE));
  if (pagesComeAtOnce()) {
    EXPECT_GE(residentPages(array, 0, kExpected), wanted - 1);
  }
  array.expect(2 * kExpected, 2 * kExpected);
  array.expect(2 * kExpected, 2 * kExpected + 1);  // less than a page
  EXPECT_EQ(residentPages(array, kExpected, 3 * kExpected), beyond);
}

TEST(Array, UnderABudgetHasNoPageBeforeItIsWritten) {
  Account account(4 * kExpected);
  Array<char> array(account, 3 * kExpected);
  const size_t before = residentPages(array, 0, 3 * kExpected);
  array.expect(0, 3 * kExpected);
  EXPECT_EQ(residentPages(array, 0, 3 * kExpected), before);
}

TEST(Array, HandsItsMemoryOverWhenMoved) {
  Account account;
  Array<int> a(account, 10);
  a[3] = 4;
  Array<int> b(std::move(a));
  EXPECT_EQ(b[3], 4);
  EXPECT_EQ(account.used(), 40u);
  a.resize(5);  // a moved-from array is an empty one
  EXPECT_EQ(account.used(), 60u);
}

TEST(PeakResidentBytes, IsAtLeastWhatWasTouched) {
  if (slowRun()) return;
  Account account;
  Array<char> array(account, size_t{40} << 20);
  for (size_t i = 0; i < array.size(); i += 4096) array[i] = 1;
  EXPECT_GE(peakResidentBytes(), uint64_t{40} << 20);
}

// ------------------------------------------------------------------------------- random

// SplitMix64's published first outputs for seed 1234567.
TEST(Random, IsTheSameEverywhere) {
  Random r(1234567);
  EXPECT_EQ(r.next(), 6457827717110365317ull);
  EXPECT_EQ(r.next(), 3203168211198807973ull);
  EXPECT_EQ(r.next(), 9817491932198370423ull);
}

TEST(Random, StaysBelowItsBound) {
  Random r(0);
  for (uint32_t bound : {1u, 2u, 3u, 6u, 1000u, 0xffffffffu}) {
    uint32_t largest = 0;
    int counts[6] = {};
    for (int k = 0; k < 6000; ++k) {
      const uint32_t x = r.below(bound);
      ASSERT_LT(x, bound);
      largest = std::max(largest, x);
      if (bound == 6) ++counts[x];
    }
    EXPECT_GE(largest, bound - 1 - bound / 100);
    for (int i = 0; bound == 6 && i < 6; ++i) EXPECT_NEAR(counts[i], 1000, 150);
  }
}

// ------------------------------------------------------------------------------- scalars

TEST(ConvertScalars, KeepsValues) {
  const double doubles[] = {0.0, -0.0, 1.5, 0.1, 1e300, -1e-300};
  float floats[6];
  convertScalars(doubles, ScalarType::kFloat64, floats, ScalarType::kFloat32, 6);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(floats[i], static_cast<float>(doubles[i]));
  double back[6];
  convertScalars(floats, ScalarType::kFloat32, back, ScalarType::kFloat64, 6);
  EXPECT_EQ(back[2], 1.5);
  EXPECT_TRUE(std::signbit(back[1]));
  const int64_t longs[] = {std::numeric_limits<int64_t>::min(), -1, int64_t{1} << 60};
  int64_t same[3];
  convertScalars(longs, ScalarType::kInt64, same, ScalarType::kInt64, 3);
  EXPECT_TRUE(std::equal(longs, longs + 3, same));
  const int32_t ints[] = {std::numeric_limits<int32_t>::min(), 0, 2147483647};
  convertScalars(ints, ScalarType::kInt32, same, ScalarType::kInt64, 3);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(same[i], ints[i]);
  int32_t narrow[3];
  convertScalars(same, ScalarType::kInt64, narrow, ScalarType::kInt32, 3);
  EXPECT_TRUE(std::equal(ints, ints + 3, narrow));
  convertScalars(ints, ScalarType::kInt32, back, ScalarType::kFloat64, 3);
  EXPECT_EQ(back[2], 2147483647.0);
  convertScalars(nullptr, ScalarType::kInt32, nullptr, ScalarType::kFloat64, 0);
}

TEST(ScalarType, KnowsItsKindAndSize) {
  EXPECT_FALSE(isKnown(static_cast<ScalarType>(0)));
  EXPECT_FALSE(isKnown(static_cast<ScalarType>(5)));
  EXPECT_TRUE(isFloat(ScalarType::kFloat64));
  EXPECT_FALSE(isFloat(ScalarType::kInt32));
  EXPECT_EQ(sizeOf(ScalarType::kFloat32) + 10 * sizeOf(ScalarType::kInt64), 84u);
}

// ------------------------------------------------------------------------------- status

TEST(Fail, ThrowsAFormattedSentenceOfAnyLength) {
  const std::string name(5000, 'n');
  try {
    fail(Status::kBadData, "%s: line %d", name.c_str(), 12);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.text(), name + ": line 12");
    EXPECT_STREQ(error.what(), error.text().c_str());
  }
  EXPECT_EQ(textOf("%s", ""), "");
  EXPECT_STREQ(statusName(Status::kBadData), "TETSTREAM_BAD_DATA");
  EXPECT_STREQ(statusName(static_cast<Status>(77)), "TETSTREAM_UNKNOWN_STATUS");
}

}  // namespace
}  // namespace tetstream::test
