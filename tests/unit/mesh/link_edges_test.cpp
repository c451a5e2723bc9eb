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
void addFan(LinkEdges& edges, uint32_t hub, uint32_t first, uint32_t count) {
  for (uint32_t i = first; i < first + count; ++i) {
    edges.add(hub, i);
    edges.add(i, i + 1);
    edges.add(i + 1, hub);
  }
}

TEST(LinkEdges, AreThoseOfOneTriangleInItsDirection) {
  LinkEdges edges;
  edges.start(9);
  addFan(edges, 7, 20, 3);
  EXPECT_EQ(singleOf(edges), (Ends{{7, 20}, {20, 21}, {21, 22}, {22, 23}, {23, 7}}));
}

TEST(LinkEdges, ForgetThoseOfTheStarBefore) {
  LinkEdges edges;
  edges.start(300);
  addFan(edges, 1000, 0, 100);
  EXPECT_EQ(singleOf(edges).size(), 102u);
  edges.start(3);
  addFan(edges, 5, 1, 1);
  EXPECT_EQ(singleOf(edges), (Ends{{5, 1}, {1, 2}, {2, 5}}));
  edges.start(0);
  EXPECT_TRUE(singleOf(edges).empty());
}

// Numbers that differ in high bits alone, and as many edges as there may be.
TEST(LinkEdges, AreFoundWhateverTheNumbers) {
  constexpr uint32_t kCount = 500, kStep = 1u << 22;
  LinkEdges edges;
  edges.start(3 * kCount);
  for (uint32_t i = 0; i < kCount; ++i) {
    const uint32_t a = i * kStep, b = a + kStep;
    edges.add(a, b);
    edges.add(b, 3);
    edges.add(3, a);
  }
  EXPECT_EQ(singleOf(edges).size(), kCount + 2);
}

}  // namespace
}  // namespace tetstream::test
