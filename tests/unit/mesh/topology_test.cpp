// The corner table against a list of cells: gather, merge, kill and pack in random order.
#include "topology.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "random.h"
#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

// Cells by number, each its corners; a number that is gone is a cell that died.
using Model = std::map<uint32_t, std::array<uint32_t, 4>>;

struct Table {
  Table(const TestMesh& mesh, bool mixed, bool linked = true)
      : topology(account, mesh.cellCount(), mesh.vertexCount(), linked),
        star(account),
        ring(account),
        stars(account) {
    for (size_t v = 0; v < mesh.vertexCount(); ++v) topology.addVertex(kFinal);
    for (size_t c = 0; c < mesh.cellCount(); ++c) {
      std::array<uint32_t, 4> corners;
      for (size_t j = 0; j < 4; ++j) corners[j] = static_cast<uint32_t>(mesh.cells[4 * c + j]);
      const bool negative = mixed && c % 3 == 1;
      if (negative) std::swap(corners[0], corners[2]);
      model[topology.addCell(corners.data(), negative ? kNegative : 0)] = corners;
    }
  }
  Account account;
  Topology topology;
  Star star, ring;
  Stars stars;
  Model model;
};

// +1 if (a, b) is an even permutation of one another.
int relativeParity(std::array<uint32_t, 4> a, const std::array<uint32_t, 4>& b) {
  int sign = 1;
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = i; j < 4; ++j)
      if (a[j] == b[i] && i != j) {
        std::swap(a[i], a[j]);
        sign = -sign;
      }
  return a == b ? sign : 0;
}

// A live cell round v as the model has it, seen from v.
void expectStarCell(const Table& t, uint32_t v, const StarCell& s) {
  const auto found = t.model.find(s.cell);
  ASSERT_TRUE(found != t.model.end());
  // The centre and its triangle are an even permutation of a positive cell, odd of a negative.
  const bool negative = t.topology.cellFlags(s.cell) & kNegative;
  EXPECT_EQ(relativeParity({v, s.t[0], s.t[1], s.t[2]}, found->second), negative ? -1 : 1);
}

// The cells with `other` are in the ring, the others in the star.
void expectStar(Table& t, uint32_t v, uint32_t other) {
  t.topology.gather(v, other, t.star, t.ring);
  std::set<uint32_t> wanted, got;
  for (const auto& [cell, corners] : t.model)
    if (std::count(corners.begin(), corners.end(), v)) wanted.insert(cell);
  for (const Star* part : {&t.star, &t.ring})
    for (const StarCell& s : *part) {
      EXPECT_TRUE(got.insert(s.cell).second) << "a cell twice in a star";
      EXPECT_EQ(s.has(other), part == &t.ring);
      expectStarCell(t, v, s);
    }
  EXPECT_EQ(wanted, got);
}

void expectStar(Table& t, uint32_t v) {
  expectStar(t, v, kNone);
  EXPECT_EQ(t.ring.size(), 0u);
  const size_t all = t.star.size();
  if (all == 0) return;
  expectStar(t, v, t.star[all / 2].t[1]);
  EXPECT_EQ(t.star.size() + t.ring.size(), all);
}

void expectSameCells(Table& t) {
  EXPECT_EQ(t.topology.liveCells(), t.model.size());
  for (uint32_t c = 0; c < t.topology.cellEnd(); ++c) {
    const auto found = t.model.find(c);
    ASSERT_EQ(t.topology.isLive(c), found != t.model.end());
    if (found != t.model.end()) {
      EXPECT_TRUE(std::equal(found->second.begin(), found->second.end(), t.topology.corners(c)));
    }
  }
}

void expectSame(Table& t) {
  expectSameCells(t);
  for (uint32_t v = 0; v < t.topology.vertexEnd(); ++v) expectStar(t, v);
}

void merge(Table& t, uint32_t u, uint32_t v) {
  t.topology.gather(u, v, t.stars.u, t.stars.ring);
  t.topology.gather(v, u, t.stars.v, t.stars.ring_from_v);
  EXPECT_EQ(t.stars.ring.size(), t.stars.ring_from_v.size());
  t.topology.merge(u, v, t.stars);
  for (auto it = t.model.begin(); it != t.model.end();) {
    auto& corners = it->second;
    const bool has_u = std::count(corners.begin(), corners.end(), u);
    const bool has_v = std::count(corners.begin(), corners.end(), v);
    std::replace(corners.begin(), corners.end(), v, u);
    it = has_u && has_v ? t.model.erase(it) : std::next(it);
  }
}

void kill(Table& t, uint32_t cell) {
  t.topology.kill(cell);
  t.model.erase(cell);
}

// Drops the vertices without cells; every other one keeps its order.
void pack(Table& t) {
  std::vector<uint32_t> keep(t.topology.vertexEnd(), kNone);
  for (const auto& [cell, corners] : t.model)
    for (uint32_t v : corners) keep[v] = 0;
  uint32_t kept = 0;
  for (uint32_t& k : keep)
    if (k != kNone) k = kept++;
  std::vector<uint8_t> flags;
  for (uint32_t v = 0; v < keep.size(); ++v)
    if (keep[v] != kNone) flags.push_back(t.topology.vertexFlags(v));
  Model packed;
  uint32_t next = 0;
  t.topology.pack(keep.data(), kept, [&](uint32_t from, uint32_t to) {
    EXPECT_EQ(to, next++);
    ASSERT_TRUE(t.model.count(from));
    for (size_t j = 0; j < 4; ++j) packed[to][j] = keep[t.model[from][j]];
  });
  EXPECT_EQ(packed.size(), t.model.size());
  EXPECT_EQ(t.topology.cellEnd(), packed.size());
  EXPECT_EQ(t.topology.vertexEnd(), kept);
  for (uint32_t v = 0; v < kept; ++v) EXPECT_EQ(t.topology.vertexFlags(v), flags[v]);
  t.model = packed;
}

// Any two vertices of a random cell, legal or not: the table's job is the same.
void randomSteps(Table& t, Random& r, int steps) {
  for (int k = 0; k < steps && t.model.size() > 3; ++k) {
    const uint32_t what = r.below(20);
    auto it = t.model.begin();
    std::advance(it, r.below(static_cast<uint32_t>(t.model.size())));
    if (what == 0) pack(t);
    if (what == 1) kill(t, it->first);
    if (what < 2) continue;
    const uint32_t i = r.below(4), j = (i + 1 + r.below(3)) % 4;
    merge(t, it->second[i], it->second[j]);
    expectStar(t, r.below(t.topology.vertexEnd()));
  }
}

TEST(Topology, IsAListOfCellsAfterAnySteps) {
  for (uint64_t seed = 0; seed < (slowRun() ? 2u : 30u); ++seed) {
    Random r(seed);
    Table t(fullGrid(3, 3, 2 + static_cast<int>(seed % 3)), seed % 2);
    expectSame(t);
    for (int round = 0; round < 6; ++round) {
      randomSteps(t, r, 8);
      expectSame(t);
    }
  }
}

TEST(Topology, TakesCellsAfterPacking) {
  Table t(fullGrid(2, 2, 2), false);
  Random r(4);
  randomSteps(t, r, 6);
  pack(t);
  const uint32_t a = t.topology.addVertex(0), corners[4] = {0, 1, 2, a};
  t.model[t.topology.addCell(corners, 0)] = {0, 1, 2, a};
  expectSame(t);
}

TEST(Topology, GivesAnEmptyStarOfAVertexWithoutCells) {
  Table t(oneCell(), false);
  kill(t, 0);
  for (uint32_t v = 0; v < 4; ++v) expectStar(t, v);
  for (uint32_t v = 0; v < 4; ++v) expectStar(t, v);  // and again, when the circle is gone
  EXPECT_EQ(t.star.size(), 0u);
}

TEST(Topology, KeepsFlags) {
  Table t(fullGrid(2, 1, 1), true);
  t.topology.flagVertex(3, kBoundary);
  t.topology.flagCell(2, kFolded);
  EXPECT_TRUE(t.topology.isFree(3));
  t.topology.flagVertex(3, kLocked);
  EXPECT_FALSE(t.topology.isFree(3));
  EXPECT_EQ(t.topology.cellFlags(2), kFolded);
  kill(t, 0);
  pack(t);
  EXPECT_EQ(t.topology.cellFlags(1), kFolded);
}

// A vertex on the boundary makes the merged one a vertex of the boundary.
TEST(Topology, KeepsTheBoundaryFlagOfEither) {
  for (bool first : {false, true}) {
    Table t(fullGrid(2, 1, 1), false);
    const uint32_t u = t.topology.corners(0)[0], v = t.topology.corners(0)[1];
    t.topology.flagVertex(first ? u : v, kBoundary);
    merge(t, u, v);
    EXPECT_TRUE(t.topology.vertexFlags(u) & kBoundary);
    EXPECT_TRUE(t.topology.vertexFlags(v) & kCollapsed);
    EXPECT_FALSE(t.topology.isFree(v));
  }
}

// Without links it takes and packs cells all the same.
TEST(Topology, WithoutLinksIsAListOfCells) {
  Table t(fullGrid(2, 2, 1), false, false);
  kill(t, 0);
  expectSameCells(t);
  pack(t);
  expectSameCells(t);
  Account account;
  Topology linked(account, 1000, 1000);
  const size_t with = account.used();
  Topology unlinked(account, 1000, 1000, false);
  EXPECT_LT(account.used() - with, 1000 * (16 + 1 + 1) + 1000u);
}

TEST(Topology, RefusesMoreThanCanBeNumbered) {
  Account account;
  Topology t(account, 1, 1);
  EXPECT_THROW(t.growCells(size_t{1} << 30), Error);
  EXPECT_THROW(t.growVertices(size_t{1} << 30), Error);
}

}  // namespace
}  // namespace tetstream::test
