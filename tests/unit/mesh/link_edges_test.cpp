#include "link_edges.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace tetstream::test {
namespace {

using Ends = std::set<std::pair<uint32_t, uint32_t>>;

Ends singleOf(const LinkEdges& edges) {
  Ends single;
  edges.forSingle([&](uint32_t from, uint32_t to) {
    EXPECT_TRUE(single.insert({from, to}).second) << from << ' ' << to;
  });
  return single;
}

// A fan of triangles (hub, i, i + 1), which leaves its rim and the sides of a gap.
void addFan(LinkEdges& edges, uint32_t hub, uint32_t first, uint32_t count, uint32_t step = 1) {
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t h = edges.numberOf(hub), a = edges.numberOf(first + i * step),
                   b = edges.numberOf(first + (i + 1) * step);
    if (!edges.isWhole()) return;
    edges.add(h, a);
    edges.add(a, b);
    edges.add(b, h);
  }
}

TEST(LinkEdges, AreThoseOfOneTriangleInItsDirection) {
  Account account;
  LinkEdges edges(account);
  edges.start();
  addFan(edges, 7, 20, 3);
  EXPECT_EQ(singleOf(edges), (Ends{{7, 20}, {20, 21}, {21, 22}, {22, 23}, {23, 7}}));
}

TEST(LinkEdges, ForgetThoseOfTheStarBefore) {
  Account account;
  LinkEdges edges(account);
  edges.start();
  addFan(edges, 1000, 0, 100);
  EXPECT_EQ(singleOf(edges).size(), 102u);
  edges.start();
  addFan(edges, 5, 1, 1);
  EXPECT_EQ(singleOf(edges), (Ends{{5, 1}, {1, 2}, {2, 5}}));
  edges.start();
  EXPECT_TRUE(singleOf(edges).empty());
}

// As many vertices as there may be, far apart; with one more nothing is to be told.
TEST(LinkEdges, AreOfSoManyVertices) {
  constexpr uint32_t kFan = LinkEdges::kMostVertices - 2, kStep = 1u << 12;
  Account account;
  LinkEdges edges(account);
  edges.start();
  addFan(edges, 3, 0, kFan, kStep);
  EXPECT_TRUE(edges.isWhole());
  EXPECT_EQ(singleOf(edges).size(), kFan + 2u);
  edges.start();
  addFan(edges, 3, 0, kFan + 1, kStep);
  EXPECT_FALSE(edges.isWhole());
  EXPECT_EQ(edges.numberOf(4), LinkEdges::kNoNumber);
  edges.start();
  EXPECT_TRUE(edges.isWhole());
}

// So many stars that the marks of all vertices come to their end.
TEST(LinkEdges, AreForgottenHoweverOften) {
  constexpr uint64_t kStars = (uint64_t{1} << 32) / LinkEdges::kMostVertices + 10;
  Account account;
  LinkEdges edges(account);
  edges.start();
  addFan(edges, 5, 1, 4);
  for (uint64_t i = 0; i < kStars; ++i) edges.start();
  addFan(edges, 5, 1, 1);
  EXPECT_EQ(singleOf(edges), (Ends{{5, 1}, {1, 2}, {2, 5}}));
}

}  // namespace
}  // namespace tetstream::test
