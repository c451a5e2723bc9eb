// Sets that are joined while their members come and go, against labels that are all kept.
#include "joined_sets.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "random.h"

namespace tetstream::test {
namespace {

// Every thing ever made has the label of its set.
class AllLabels {
 public:
  size_t make() {
    labels_.push_back(labels_.size());
    return labels_.size() - 1;
  }
  bool join(size_t a, size_t b) {
    const size_t from = labels_[a], to = labels_[b];
    std::replace(labels_.begin(), labels_.end(), from, to);
    return from != to;
  }
  size_t sets() const { return std::set<size_t>(labels_.begin(), labels_.end()).size(); }

 private:
  std::vector<size_t> labels_;
};

struct Held {
  uint32_t member;
  size_t thing;
};

// Things are made, joined and let go of at random; so many are held at once, about.
void expectLabels(uint64_t seed, size_t held, int rounds) {
  Account account;
  JoinedSets sets(account);
  AllLabels labels;
  std::vector<Held> members;
  Random random(seed);
  const auto any = [&] { return random.below(static_cast<uint32_t>(members.size())); };
  for (int n = 0; n < rounds; ++n) {
    if (random.below(3) == 0 || members.empty()) members.push_back({sets.make(), labels.make()});
    const Held a = members[any()], b = members[any()];
    ASSERT_EQ(sets.join(a.member, b.member), labels.join(a.thing, b.thing));
    ASSERT_FALSE(sets.join(b.member, a.member));
    if (members.size() <= held) continue;
    std::swap(members[any()], members.back());
    sets.release(members.back().member);
    members.pop_back();
  }
  EXPECT_EQ(sets.sets(), static_cast<int64_t>(labels.sets()));
  std::set<uint32_t> different;
  for (const Held& m : members) different.insert(m.member);
  EXPECT_EQ(different.size(), members.size());
}

TEST(JoinedSets, JoinWhatIsNotYetTogether) {
  for (uint64_t seed : {1, 2, 3})
    for (size_t held : {1, 2, 10, 300}) expectLabels(seed, held, 3000);
}

TEST(JoinedSets, StayTogetherWhenWhatJoinedThemIsGone) {
  Account account;
  JoinedSets sets(account);
  const uint32_t a = sets.make(), between = sets.make(), b = sets.make();
  EXPECT_TRUE(sets.join(a, between));
  EXPECT_TRUE(sets.join(between, b));
  sets.release(between);
  const uint32_t other = sets.make();
  EXPECT_FALSE(sets.join(a, b));
  EXPECT_EQ(sets.sets(), 2);
  EXPECT_TRUE(sets.join(other, b));
  EXPECT_FALSE(sets.join(other, a));
  EXPECT_EQ(sets.sets(), 1);
}

TEST(JoinedSets, CountThoseThatNobodyHolds) {
  Account account;
  JoinedSets sets(account);
  for (int n = 1; n <= 1000; ++n) {
    sets.release(sets.make());
    EXPECT_EQ(sets.sets(), n);
  }
}

// A chain of a million, of which ten are held at once.
TEST(JoinedSets, TakeTheMemoryOfTheMembersHeldAtOnce) {
  Account account;
  JoinedSets sets(account);
  std::vector<uint32_t> members;
  for (int n = 0; n < 1000000; ++n) {
    members.push_back(sets.make());
    ASSERT_EQ(sets.join(members[members.size() > 1 ? members.size() - 2 : 0], members.back()),
              n > 0);
    if (members.size() < 10) continue;
    sets.release(members.front());
    members.erase(members.begin());
  }
  EXPECT_EQ(sets.sets(), 1);
  EXPECT_LE(account.peak(), 256 * 2 * sizeof(uint32_t));
}

// Its first member stays, and each new part was the larger one when it came.
TEST(JoinedSets, TakeNoMoreMemoryForAMemberThatIsHeldForLong) {
  Account account;
  JoinedSets sets(account);
  const uint32_t first = sets.make();
  uint32_t last = first;
  for (int n = 0; n < 100000; ++n) {
    const uint32_t part[3] = {sets.make(), sets.make(), sets.make()};
    sets.join(part[0], part[1]);
    sets.join(part[0], part[2]);
    ASSERT_TRUE(sets.join(last, part[0]));
    for (uint32_t member : {part[1], part[2], last})
      if (member != first) sets.release(member);
    last = part[0];
  }
  EXPECT_FALSE(sets.join(first, last));
  EXPECT_EQ(sets.sets(), 1);
  EXPECT_LE(account.peak(), 256 * 2 * sizeof(uint32_t));
}

// Whoever of them goes first.
TEST(JoinedSets, AreForgottenWithTheirLastMember) {
  Account account;
  JoinedSets sets(account);
  Random random(1);
  for (int n = 0; n < 10000; ++n) {
    std::vector<uint32_t> members;
    while (members.size() < 12) members.push_back(sets.make());
    for (int k = 0; k < 20; ++k) sets.join(members[random.below(12)], members[random.below(12)]);
    while (!members.empty()) {
      std::swap(members[random.below(static_cast<uint32_t>(members.size()))], members.back());
      sets.release(members.back());
      members.pop_back();
    }
  }
  EXPECT_LE(account.peak(), 256 * 2 * sizeof(uint32_t));
}

}  // namespace
}  // namespace tetstream::test
