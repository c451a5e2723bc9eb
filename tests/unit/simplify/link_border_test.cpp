// The border of a link: against a count of all its edges, and where it is none that can be used.
#include "link_border.h"

#include <gtest/gtest.h>
#include <map>

#include "mesh_facts.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

// A link as triangles that all turn the same way.
struct Link {
  explicit Link(const std::vector<std::array<uint32_t, 3>>& triangles) : star(account) {
    for (const auto& t : triangles)
      star.add() = {static_cast<uint32_t>(star.size()), {t[0], t[1], t[2]}};
  }
  std::vector<uint64_t> single() const {
    std::map<uint64_t, int> count;
    for (const StarCell& s : star)
      for (size_t k = 0; k < 3; ++k) {
        const uint64_t a = s.t[k], b = s.t[(k + 1) % 3];
        ++count[a < b ? a << 32 | b : b << 32 | a];
      }
    std::vector<uint64_t> edges;
    for (const auto& [edge, times] : count)
      if (times == 1) edges.push_back(edge);
    return edges;
  }
  Account account;
  Star star;
};

using Triangles = std::vector<std::array<uint32_t, 3>>;

Triangles linkOf(const TestMesh& mesh, int64_t v) {
  Triangles triangles;
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    for (size_t j = 0; j < 4; ++j) {
      if (mesh.cells[4 * c + j] != v) continue;
      std::array<uint32_t, 3> t{};
      for (size_t k = 0; k < 3; ++k)
        t[k] = static_cast<uint32_t>(mesh.cells[4 * c + kOpposite[j][k]]);
      if (cellSign(mesh, c) < 0) std::swap(t[0], t[1]);
      triangles.push_back(t);
    }
  return triangles;
}

TEST(LinkBorder, IsThatOfAllEdgesOfOneCell) {
  for (const TestMesh& mesh : {fullGrid(3, 3, 3), ringGrid(4), shellGrid(4)}) {
    int found = 0;
    Account account;
    LinkBorder border(account);
    for (size_t v = 0; v < mesh.vertexCount(); ++v) {
      const Link link(linkOf(mesh, static_cast<int64_t>(v)));
      const std::vector<uint64_t> single = link.single();
      ASSERT_EQ(border.find(link.star), !single.empty()) << v;
      if (single.empty()) continue;
      EXPECT_EQ(border.edges(), single) << v;
      EXPECT_TRUE(border.isCircle(single)) << v;
      ++found;
    }
    EXPECT_GT(found, 0);
  }
}

// Two fans that meet in a vertex of the link, an annulus of which one border has three edges.
TEST(LinkBorder, IsNotTakenForThatOfADisk) {
  Account account;
  LinkBorder border(account);
  EXPECT_TRUE(border.find(Link({{1, 2, 3}, {1, 4, 5}}).star));
  EXPECT_FALSE(border.isCircle(border.edges()));
  const Triangles annulus = {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}, {2, 5, 0}, {0, 5, 3}};
  EXPECT_FALSE(border.find(Link(annulus).star));
}

// A triangle twice, one folded over its neighbour, one of three at an edge.
TEST(LinkBorder, IsNotFoundWhereCellsLieOverCells) {
  Account account;
  LinkBorder border(account);
  EXPECT_FALSE(border.find(Link({{1, 2, 3}, {1, 2, 3}}).star));
  EXPECT_FALSE(border.find(Link({{1, 2, 3}, {1, 2, 4}}).star));
  EXPECT_FALSE(border.find(Link({{1, 2, 3}, {2, 1, 4}, {1, 2, 5}}).star));
}

TEST(LinkBorder, IsOneCircleOrNot) {
  Account account;
  LinkBorder border(account);
  const auto edge = [](uint64_t a, uint64_t b) { return a << 32 | b; };
  EXPECT_TRUE(border.isCircle({edge(1, 2), edge(1, 3), edge(2, 3)}));
  EXPECT_FALSE(border.isCircle({edge(1, 2), edge(2, 3)}));
  EXPECT_FALSE(
      border.isCircle({edge(1, 2), edge(1, 3), edge(2, 3), edge(4, 5), edge(4, 6), edge(5, 6)}));
  EXPECT_FALSE(
      border.isCircle({edge(1, 2), edge(1, 3), edge(2, 3), edge(1, 4), edge(1, 5), edge(4, 5)}));
}

// Many stars, so that numbers are forgotten often, with vertices far apart.
TEST(StarNumbers, CountFromNothingEachTime) {
  Account account;
  StarNumbers numbers(account);
  for (uint32_t round = 0; round < 1000; ++round) {
    numbers.start(40);
    for (uint32_t i = 0; i < 40; ++i) ASSERT_EQ(numbers.numberOf(i * 0x1000000u + round), i);
    ASSERT_EQ(numbers.numberOf(round), 0u);
    ASSERT_EQ(numbers.count(), 40u);
  }
}

}  // namespace
}  // namespace tetstream::test
