// The walks round a vertex against a look at every cell, and the same from every build.
#include "star_kernels.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <set>
#include <vector>

#include "random.h"
#include "star_walks.inl"
#include "test_mesh.h"

namespace tetstream {

namespace test {
namespace {

int rounds() {
  return slowRun() ? 20 : 400;
}

// Cells of a few vertices, some of them dead.
struct Cells {
  explicit Cells(Random& r) {
    const size_t count = 1 + r.below(50);
    for (size_t c = 0; c < count; ++c) {
      std::set<uint16_t> chosen;
      while (chosen.size() < 4) chosen.insert(static_cast<uint16_t>(r.below(12)));
      std::vector<uint16_t> cell(chosen.begin(), chosen.end());
      for (size_t i = 0; i < 4; ++i) std::swap(cell[i], cell[i + r.below(4 - uint32_t(i))]);
      if (r.below(6) == 0) cell.assign(4, kGoneCorner);
      corners.insert(corners.end(), cell.begin(), cell.end());
    }
  }
  bool has(size_t cell, uint16_t v) const {
    return std::count(&corners[4 * cell], &corners[4 * cell] + 4, v) > 0;
  }
  bool live(size_t cell) const { return corners[4 * cell] != kGoneCorner; }
  // Those that hold v or are dead, as the list of a vertex does.
  std::vector<uint16_t> listOf(uint16_t v) const {
    std::vector<uint16_t> list;
    for (size_t c = 0; c < corners.size() / 4; ++c)
      if (has(c, v) || !live(c)) list.push_back(static_cast<uint16_t>(c));
    return list;
  }
  std::vector<uint16_t> corners;
};

bool sameCell(const StarCell& a, const StarCell& b) {
  return a.cell == b.cell && std::equal(a.t, a.t + 3, b.t);
}

int parityOf(const uint16_t* cell, const std::array<uint32_t, 4>& seen) {
  int swaps = 0;
  std::array<uint32_t, 4> places;
  for (size_t i = 0; i < 4; ++i)
    places[i] = static_cast<uint32_t>(std::find(cell, cell + 4, seen[i]) - cell);
  for (size_t i = 0; i < 4; ++i)
    for (size_t j = i + 1; j < 4; ++j) swaps += places[i] > places[j];
  return swaps % 2;
}

using LookRound = StarCounts (*)(const uint16_t*, uint16_t*, uint32_t, uint16_t, uint16_t,
                                 StarCell*, StarCell*);
void expectLook(LookRound look, const Cells& cells, uint16_t v, uint16_t other) {
  std::vector<uint16_t> list = cells.listOf(v), wanted;
  size_t rings = 0;
  for (uint16_t c : list)
    if (cells.live(c)) {
      wanted.push_back(c);
      rings += cells.has(c, other);
    }
  std::vector<StarCell> star(list.size() + kStarSlack), ring(star);
  const StarCounts counts =
      look(cells.corners.data(), list.data(), static_cast<uint32_t>(list.size()), v, other,
           star.data(), ring.data());
  ASSERT_EQ(counts.ring, rings);
  ASSERT_EQ(counts.star + counts.ring, wanted.size());
  list.resize(wanted.size());
  EXPECT_TRUE(list == wanted);  // the dead are taken out
  star.resize(counts.star);
  star.insert(star.end(), ring.begin(), ring.begin() + counts.ring);
  for (size_t i = 0; i < star.size(); ++i) {
    const StarCell& s = star[i];
    const uint16_t* cell = &cells.corners[4 * s.cell];
    EXPECT_TRUE(cells.has(s.cell, v));
    EXPECT_EQ(cells.has(s.cell, other), i >= counts.star);
    EXPECT_EQ(parityOf(cell, {v, s.t[0], s.t[1], s.t[2]}), 0);
  }
}

TEST(LookRound, GivesTheLiveCellsOfAVertexInBothBuilds) {
  Random r(6);
  for (int k = 0; k < rounds(); ++k) {
    const Cells cells(r);
    const auto v = static_cast<uint16_t>(r.below(12));
    const auto other = r.below(5) ? static_cast<uint16_t>((v + 1 + r.below(11)) % 12) : kGoneCorner;
    expectLook(lookRound, cells, v, other);
    expectLook(lookRoundOf, cells, v, other);
    std::vector<uint16_t> list = cells.listOf(v), same = list;
    std::vector<StarCell> star(list.size() + kStarSlack), ring(star), star2 = star, ring2 = ring;
    const auto count = static_cast<uint32_t>(list.size());
    const StarCounts n =
        lookRound(cells.corners.data(), list.data(), count, v, other, star.data(), ring.data());
    lookRoundOf(cells.corners.data(), same.data(), count, v, other, star2.data(), ring2.data());
    EXPECT_TRUE(std::equal(star.begin(), star.begin() + n.star, star2.begin(), sameCell));
    EXPECT_TRUE(std::equal(ring.begin(), ring.begin() + n.ring, ring2.begin(), sameCell));
  }
}

TEST(ListVertices, GivesEachOnceThatWasNotSeen) {
  Random r(7);
  for (int k = 0; k < rounds(); ++k) {
    Cells cells(r);
    for (uint16_t& corner : cells.corners) corner = corner == kGoneCorner ? 11 : corner;
    std::vector<uint16_t> list;
    for (size_t c = 0; c < cells.corners.size() / 4; c += 2)
      list.push_back(static_cast<uint16_t>(c));
    std::vector<uint32_t> seen(12, 3), out(4 * list.size() + 1);
    seen[4] = 0xffffffffu;  // one that never counts
    seen[5] = 7;
    std::set<uint32_t> wanted;
    for (uint16_t c : list) wanted.insert(&cells.corners[4 * c], &cells.corners[4 * c] + 4);
    wanted.erase(4);
    wanted.erase(5);
    std::vector<uint32_t> seen2 = seen, out2 = out;
    const auto count = static_cast<uint32_t>(list.size());
    const size_t n =
        listVertices(cells.corners.data(), list.data(), count, seen.data(), 7, out.data());
    ASSERT_EQ(n, wanted.size());
    EXPECT_EQ(std::set<uint32_t>(out.begin(), out.begin() + static_cast<long>(n)), wanted);
    for (uint32_t v : wanted) EXPECT_EQ(seen[v], 7u);
    listVerticesOf(cells.corners.data(), list.data(), count, seen2.data(), 7, out2.data());
    EXPECT_TRUE(seen == seen2);
    EXPECT_TRUE(std::equal(out.begin(), out.begin() + static_cast<long>(n), out2.begin()));
  }
}

TEST(ListVertices, GivesThoseOfStarCellsToo) {
  Random r(8);
  for (int k = 0; k < rounds(); ++k) {
    std::vector<StarCell> cells(1 + r.below(30));
    std::vector<uint32_t> seen(12, 3), out(3 * cells.size() + 1);
    seen[5] = 7;  // seen before
    std::set<uint32_t> wanted;
    for (StarCell& cell : cells)
      for (uint32_t& t : cell.t) wanted.insert(t = r.below(12));
    wanted.erase(5);
    std::vector<uint32_t> seen2 = seen, out2 = out;
    const size_t n = listVertices(cells.data(), cells.size(), seen.data(), 7, out.data());
    ASSERT_EQ(n, wanted.size());
    EXPECT_EQ(std::set<uint32_t>(out.begin(), out.begin() + static_cast<long>(n)), wanted);
    listVerticesOf(cells.data(), cells.size(), seen2.data(), 7, out2.data());
    EXPECT_TRUE(seen == seen2);
    EXPECT_TRUE(std::equal(out.begin(), out.begin() + static_cast<long>(n), out2.begin()));
  }
}

// The four faces of a cell are the link of a vertex inside it: of the cells with that vertex in the
// place of one corner each.
TEST(LinkSums, AreZeroOfClosedLinksOnly) {
  Random r(9);
  for (int k = 0; k < rounds(); ++k) {
    std::set<uint32_t> chosen;
    while (chosen.size() < 5) chosen.insert(r.below(1000));
    const std::vector<uint32_t> v(chosen.begin(), chosen.end());
    const uint32_t centre = v[4];
    std::vector<uint64_t> sums(1000), same(1000);
    for (uint32_t j = 0; j < 4; ++j) {
      EXPECT_EQ(sums[centre] == 0, j == 0) << "after " << j << " cells";
      uint32_t cell[4] = {v[0], v[1], v[2], v[3]}, taken[4];
      cell[j] = centre;
      const bool turned = r.below(2) == 1;
      if (turned) std::swap(cell[0], cell[3]);
      for (size_t i = 0; i < 4; ++i) taken[i] = cell[i] == v[2] ? 0 : ~0u;
      addToLinkSums(cell, turned, taken, sums.data());
      addToLinkSumsOf(cell, turned, taken, same.data());
    }
    EXPECT_EQ(sums[centre], 0u);
    for (uint32_t j : {0u, 1u, 3u}) EXPECT_NE(sums[v[j]], 0u);
    EXPECT_EQ(sums[v[2]], 0u);  // it took nothing
    EXPECT_TRUE(sums == same);
  }
}

}  // namespace
}  // namespace test
}  // namespace tetstream
