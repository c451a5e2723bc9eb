// Where very many cells or triangles meet at a place few of them are looked at, and none is missed
// that matters.
#include "hub_hulls.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <limits>
#include <numbers>
#include <set>

#include "cell_overlap.h"
#include "field_testing.h"
#include "row_chunk.h"
#include "triangle.h"

namespace tetstream::test {
namespace {

using Simplices = std::vector<std::vector<double>>;

// The chunk of all of them.
struct Chunk {
  explicit Chunk(const Simplices& simplices)
      : rows(rowsOf(simplices, {simplices[0].size() / 3, 0}, noValues, account)),
        chunk(*rows, 0, simplices.size(), account) {}
  Account account;
  std::unique_ptr<SimplexRows> rows;
  RowChunk chunk;
};

void add(std::vector<double>& simplex, double x, double y, double z) {
  simplex.insert(simplex.end(), {x, y, z});
}

// `count` sectors of a circle round the z axis, the first ones of as many as `of`: triangles, or
// cells that have a piece of the axis in common.
Simplices sectors(int count, int of, bool are_cells) {
  Simplices all;
  for (int i = 0; i < count; ++i) {
    std::vector<double> simplex = {0, 0, 0};
    if (are_cells) add(simplex, 0, 0, 1);
    for (const int end : {i, i + 1}) {
      const double turn = 2 * std::numbers::pi * (end % of) / of;
      add(simplex, std::cos(turn), std::sin(turn), 0);
    }
    all.push_back(simplex);
  }
  return all;
}

// In the unit cube and beside it; most of them with a hub, one of three, each on its own.
Simplices randomAtHubs(Random& random, size_t corners) {
  const std::vector<double> hubs = randomSimplex(random, 3, 1);
  Simplices all;
  for (size_t i = 0; i < 1500; ++i) {
    std::vector<double> simplex = randomSimplex(random, corners, i % 50 ? 0.1 : 0.7);
    if (i % 4 < 3) std::copy_n(&hubs[3 * (i % 4)], 3, &simplex[3 * random.below(corners)]);
    all.push_back(simplex);
  }
  return all;
}

double overlapOf(const Cell& a, const double* b) {
  CellMap map;
  double planes[4][4];
  CellOverlap overlap;
  const bool meets = map.set(b) && map.planesOf(a.data(), planes) && overlap.set(planes);
  return meets ? overlap.volume : 0;
}

// -------------------------------------------------------------------------------------- hubs

TEST(Hubs, AreWhereVeryManyRowsMeet) {
  for (const uint32_t rows : {Hubs::kManyRows - 1, Hubs::kManyRows}) {
    const Chunk all(sectors(static_cast<int>(rows), static_cast<int>(rows), false));
    const Hubs& hubs = all.chunk.hubs();
    ASSERT_EQ(hubs.count(), rows < Hubs::kManyRows ? 0u : 1u);
    const double centre[3] = {0, 0, -0.0}, beside[3] = {1, 0, 0};
    EXPECT_EQ(hubs.find(centre), hubs.count() > 0 ? 0 : Hubs::kNone);
    EXPECT_EQ(hubs.find(beside), Hubs::kNone);
  }
}

TEST(Hubs, AreNowhereInOrdinaryMeshes) {
  EXPECT_EQ(Chunk(cubeOf(12)).chunk.hubs().count(), 0u);
}

// Of many rows a part is looked at.
TEST(Hubs, AreFoundAmongManyRows) {
  Random random(1);
  Simplices all;
  for (size_t i = 0; i < 2 * Hubs::kSample; ++i) {
    all.push_back(randomSimplex(random, 3, 0.1));
    if (i % 50 == 0) std::fill_n(all.back().begin(), 3, 0.5);
  }
  EXPECT_EQ(Chunk(all).chunk.hubs().count(), 1u);
}

// ------------------------------------------------------------------------------------- cells

TEST(HubHulls, FindCellsRoundAnAxisWithFewVisits) {
  constexpr int kCells = 3000;
  const Simplices cells = sectors(kCells, kCells, true);
  const Chunk all(cells);
  ASSERT_EQ(all.chunk.hubs().count(), 2u);
  size_t visits = 0;
  for (size_t i = 0; i < kCells; ++i) {
    bool found = false;
    all.chunk.forEachNear(cells[i].data(), [&](uint32_t n) {
      ++visits;
      found |= n == i;
    });
    EXPECT_TRUE(found);
  }
  EXPECT_LE(visits, size_t{30} * kCells);
}

TEST(HubHulls, MissNoCellThatHasSomethingInCommon) {
  Random random(2);
  const Simplices cells = randomAtHubs(random, 4), asked = randomAtHubs(random, 4);
  const Chunk all(cells);
  ASSERT_EQ(all.chunk.hubs().count(), 3u);
  size_t overlaps = 0;
  for (size_t n = 0; n < 300; ++n) {
    const Cell& cell = n % 2 ? cells[n] : asked[n];
    std::set<uint32_t> seen;
    all.chunk.forEachNear(cell.data(), [&](uint32_t i) { EXPECT_TRUE(seen.insert(i).second); });
    for (uint32_t i = 0; i < cells.size(); ++i) {
      if (!(overlapOf(cell, all.chunk.row(i)) > 1e-12)) continue;
      ++overlaps;
      EXPECT_TRUE(seen.count(i));
    }
  }
  EXPECT_GT(overlaps, 3000u);
}

TEST(HubHulls, MissNothingNearAFlatCell) {
  const Chunk all(sectors(400, 400, true));
  const Cell flat = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  size_t visits = 0;
  all.chunk.forEachNear(flat.data(), [&](uint32_t) { ++visits; });
  EXPECT_GE(visits, 100u);
}

// Half of the circle has no other cell. Its centre, where the values are highest, does.
TEST(HubHulls, LeaveNoHubOutside) {
  const Values high = [](const double* at) {
    return std::vector{at[0] == 0 && at[1] == 0 ? 100.0 : 0};
  };
  const std::vector<double> surface = {0, 0, 0, 1, 0, 0, 0, 0, 1};
  const Measured m({sectors(600, 600, true), high}, {sectors(300, 600, true), high},
                   {{surface}, linear(0)});
  EXPECT_NEAR(m.volumes().covered, m.volumes().original / 2, 1e-13);
  EXPECT_NEAR(m.volumes().outside, m.volumes().original / 2, 1e-13);
  EXPECT_LE(m.inside().largest, 1e-11);
  EXPECT_GT(m.outside().largest, 50);
  EXPECT_LT(m.outside().largest, 99.99);
}

// -------------------------------------------------------------------------------- triangles

// The nearest one, among all, but for the rounding of what is as near.
double leastOf(const Chunk& all, const double place[3], size_t* visits) {
  double found = std::numeric_limits<double>::infinity(), at[3];
  all.chunk.forEachWithin(place, found, [&](uint32_t i) {
    ++*visits;
    return found = std::min(found, squaredDistance(all.chunk.row(i), place, at));
  });
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < all.chunk.count(); ++i)
    least = std::min(least, squaredDistance(all.chunk.row(i), place, at));
  EXPECT_NEAR(found, least, 1e-15 * least);
  return least;
}

// Beside the circle, as places of a boundary are by rounding.
TEST(HubHulls, FindTheNearestSectorWithFewVisits) {
  const Chunk all(sectors(2000, 2000, false));
  ASSERT_EQ(all.chunk.hubs().count(), 1u);
  Random random(3);
  size_t visits = 0;
  for (int n = 0; n < 200; ++n) {
    const double place[3] = {uniform(random) / 2 + 0.1, uniform(random) / 2 + 0.1, 1e-9};
    EXPECT_LE(leastOf(all, place, &visits), 1e-17);
  }
  EXPECT_LE(visits, 200u * 40);
}

TEST(HubHulls, FindTheNearestTriangleWhereverAPlaceIs) {
  Random random(4);
  const Chunk all(randomAtHubs(random, 3));
  ASSERT_EQ(all.chunk.hubs().count(), 3u);
  size_t visits = 0;
  for (int n = 0; n < 500; ++n) leastOf(all, randomSimplex(random, 1, 1).data(), &visits);
  for (uint32_t hub = 0; hub < 3; ++hub)
    EXPECT_EQ(leastOf(all, all.chunk.hubs().place(hub), &visits), 0);
}

// -------------------------------------------------------------------------------------- bytes

TEST(HubHulls, TakeNoMoreThanAChunkHas) {
  for (const bool are_cells : {false, true}) {
    const Simplices simplices = sectors(5000, 5000, are_cells);
    Account held;
    const auto rows = rowsOf(simplices, {simplices[0].size() / 3, 0}, noValues, held);
    for (const size_t bytes : {100000, 1000000}) {
      Account account(bytes);  // which throws where more is taken
      size_t hubs = 0;
      forEachChunk(*rows, bytes, 0, account,
                   [&](const RowChunk& chunk) { hubs += chunk.hubs().count(); });
      EXPECT_GT(hubs, 0u);
    }
  }
}

}  // namespace
}  // namespace tetstream::test
