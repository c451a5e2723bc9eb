// The front against a std::map under random traffic; width and span to the last vertex.
#include "front.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <map>
#include <vector>

#include "random.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

struct Traffic {
  uint32_t steps;         // vertices introduced
  uint32_t busy;          // active at once, about
  uint32_t stale_one_in;  // one vertex in so many lives to the end
  uint64_t expected_span;
};

// The front and its model, side by side.
class Pair {
 public:
  explicit Pair(uint64_t expected_span) : front(account, expected_span) {}

  void introduce(uint32_t slot) {
    const uint64_t rank = front.introduced();
    front.introduce(slot);
    model[rank] = slot;
    width = std::max<int64_t>(width, static_cast<int64_t>(model.size()));
    span = std::max<int64_t>(span, static_cast<int64_t>(rank - model.begin()->first + 1));
  }
  void finalize(uint64_t vertex) { EXPECT_EQ(front.finalize(vertex), model.erase(vertex) == 1); }
  // Found at once or not at all; never where one of them is not active.
  void expectFour(uint64_t first) {
    const auto v = static_cast<int64_t>(first);
    const int64_t four[4] = {v + 3, v, v + 2, v + 1}, strange[4] = {v, v + 1, -v - 1, v + 2},
                  far[4] = {v, v + 1, v + 2, v + (int64_t{1} << 50)};
    uint32_t slots[4];
    const bool found = front.findFour(four, slots);
    for (int j = 0; found && j < 4; ++j) {
      const auto it = model.find(static_cast<uint64_t>(four[j]));
      ASSERT_NE(it, model.end());
      ASSERT_EQ(it->second, slots[j]);
    }
    EXPECT_FALSE(front.findFour(strange, slots));
    EXPECT_FALSE(front.findFour(far, slots));
  }
  void expectSame(uint64_t from, uint64_t to) {
    for (uint64_t v = from; v < to; ++v) {
      const auto it = model.find(v);
      ASSERT_EQ(front.find(v), it == model.end() ? kNoSlot : it->second) << v;
    }
    for (uint64_t v = from; v + 4 <= to; v += 3) expectFour(v);
    EXPECT_EQ(front.active(), model.size());
    EXPECT_EQ(front.width(), width);
    EXPECT_EQ(front.span(), span);
  }

  Account account;
  Front front;
  std::map<uint64_t, uint32_t> model;
  int64_t width = 0, span = 0;
};

// Swaps the slots of all active vertices round, as packing a window does.
void remap(Pair& p) {
  std::vector<uint32_t> new_slot(1 << 20, kNoSlot);
  uint32_t next = 0;
  for (auto& [v, slot] : p.model) {
    new_slot[slot] = next;
    slot = next++;
  }
  p.front.remap(new_slot.data());
}

void drive(const Traffic& traffic, uint64_t seed) {
  Pair p(traffic.expected_span);
  Random r(seed);
  std::vector<uint64_t> young;  // what may be finalized soon
  uint32_t slot = 0;
  for (uint32_t step = 0; step < traffic.steps; ++step) {
    const uint64_t rank = p.front.introduced();
    p.introduce(slot++);
    if (r.below(traffic.stale_one_in) != 0) young.push_back(rank);
    while (young.size() > traffic.busy || (!young.empty() && r.below(50) == 0)) {
      const size_t i = r.below(static_cast<uint32_t>(young.size()));
      p.finalize(young[i]);
      young[i] = young.back();
      young.pop_back();
    }
    if (r.below(400) == 0) p.finalize(rank / 2);  // mostly not active
    if (r.below(5000) == 0) {
      remap(p);
      slot = static_cast<uint32_t>(p.model.size());
    }
    if (r.below(3000) == 0) p.expectSame(rank > 3000 ? rank - 3000 : 0, rank + 3);
  }
  p.expectSame(0, p.front.introduced() + 2);
  // All that are left, in any order, so that gaps in the hash are closed again and again.
  while (!p.model.empty()) {
    auto it = p.model.lower_bound(r.next() % traffic.steps);
    if (it == p.model.end()) it = p.model.begin();
    p.finalize(it->first);
    if (r.below(500) == 0) p.expectSame(0, p.front.introduced());
  }
  p.expectSame(0, p.front.introduced());
}

uint32_t steps() {
  return slowRun() ? 9000 : 60000;
}

TEST(IdHash, IsAsItWasWhereItCannotGrow) {
  Account small(30000);
  IdHash hash(small);
  uint64_t id = 0;
  const auto fill = [&] {
    for (; id < 5000; ++id) hash.add(7 * id, static_cast<uint32_t>(id));
  };
  EXPECT_THROW(fill(), Error);
  EXPECT_GT(id, 100u);
  EXPECT_EQ(hash.count(), id);
  for (uint64_t k = 0; k < id; ++k) EXPECT_EQ(hash.find(7 * k), k);
  EXPECT_EQ(hash.find(7 * id), kNoSlot);
}

TEST(Front, IsAMapForStreamsOfLowSpan) {
  drive({steps(), 300, 1000000, 0}, 1);
}
// One in 20 lives on: after 4096 vertices the ring's places are claimed again, thousands of old
// ones go to the hash, the ring doubles.
TEST(Front, IsAMapForStreamsOfHighSpan) {
  drive({steps(), 300, 20, 0}, 2);
}
TEST(Front, IsAMapWhenFewVerticesLiveLong) {
  drive({steps(), 100, 400, 0}, 3);
}
TEST(Front, IsAMapWhenAllVerticesLiveLong) {
  drive({slowRun() ? 6000u : 20000u, 30000, 2, 0}, 4);
}
TEST(Front, IsAMapWhateverSpanWasExpected) {
  for (uint64_t expected : {uint64_t{1}, uint64_t{5000}, uint64_t{100000}})
    drive({steps() / 3, 2000, 50, expected}, 5);
}

TEST(Front, CountsWidthAndSpanByHand) {
  Account account;
  Front front(account);
  EXPECT_EQ(front.width(), 0);
  for (uint32_t k = 0; k < 3; ++k) front.introduce(k);
  EXPECT_TRUE(front.finalize(1));
  EXPECT_FALSE(front.finalize(1));
  EXPECT_FALSE(front.finalize(3));
  EXPECT_EQ(front.active(), 2u);
  front.introduce(3);  // 0 and 3 active: a span of 4
  EXPECT_EQ(front.width(), 3);
  EXPECT_EQ(front.span(), 4);
  EXPECT_TRUE(front.finalize(0));
  EXPECT_TRUE(front.finalize(2));
  EXPECT_TRUE(front.finalize(3));
  front.introduce(4);  // alone: nothing before it counts
  EXPECT_EQ(front.span(), 4);
  EXPECT_EQ(front.find(4), 4u);
}

// Ids of any size may be asked for: they are the caller's.
TEST(Front, KnowsNothingOfVerticesToCome) {
  Account account;
  Front front(account);
  for (uint32_t k = 0; k < 10; ++k) front.introduce(k);
  for (uint64_t v :
       {uint64_t{10}, uint64_t{4096}, uint64_t{4097}, uint64_t{1} << 40, ~uint64_t{0}}) {
    EXPECT_EQ(front.find(v), kNoSlot);
    EXPECT_FALSE(front.finalize(v));
  }
}

TEST(Front, GivesItsMemoryBack) {
  Account account;
  {
    Front front(account, 1 << 20);
    EXPECT_GE(account.used(), size_t{8} << 20);
    EXPECT_LE(account.used(), size_t{9} << 20);
  }
  EXPECT_EQ(account.used(), 0u);
  Account small(1000);
  EXPECT_THROW(Front(small, 0), std::exception);
  EXPECT_EQ(small.used(), 0u);
}

// A stream whose vertices all die young stays in the smallest ring, whatever its length.
TEST(Front, TakesNoMoreMemoryForALongerStream) {
  Account account;
  Front front(account);
  const size_t before = account.used();
  for (uint32_t k = 0; k < 200000; ++k) {
    front.introduce(k % 1000);
    if (k >= 100) front.finalize(k - 100);
  }
  EXPECT_EQ(account.used(), before);
  EXPECT_EQ(front.width(), 101);
}

}  // namespace
}  // namespace tetstream::test
