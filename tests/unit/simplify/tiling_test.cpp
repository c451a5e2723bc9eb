// Tiles: every free vertex in one, with all cells that its patch needs, apart where the colour is
// the same.
#include "tiling.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "random.h"
#include "tasks.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

// In how many tiles each vertex is.
template <class S>
std::vector<int> ownersOf(const Tiling<S>& tiling, size_t vertices) {
  std::vector<int> owners(vertices, 0);
  for (const TilePiece& t : tiling.tiles())
    for (size_t i = 0; i < t.vertexCount(); ++i) ++owners[tiling.vertices(t)[i]];
  return owners;
}

// All cells of the tile's vertices; of others only such as no tile needs.
template <class S>
void expectCellsOfTile(const Window<S>& window, Tiling<S>& tiling, const TilePiece& tile,
                       const std::vector<int>& owners) {
  std::vector<bool> owned(window.mesh.vertexEnd(), false);
  for (size_t i = 0; i < tile.vertexCount(); ++i) owned[tiling.vertices(tile)[i]] = true;
  std::set<uint32_t> listed;
  Account account;
  Array<uint32_t> room(account);
  const uint32_t* cells = tiling.listCells(tile, room);
  for (size_t i = 0; i < tile.cell_count; ++i)
    EXPECT_TRUE(listed.insert(cells[i]).second) << "a cell twice in a tile";
  for (uint32_t c = 0; c < window.cellEnd(); ++c) {
    if (!window.isLive(c)) continue;
    bool is_wanted = false, is_anyones = false;
    for (uint32_t j = 0; j < 4; ++j) {
      is_wanted |= owned[window.vertexOf(c, j)];
      is_anyones |= owners[window.vertexOf(c, j)] > 0;
    }
    const bool is_listed = listed.erase(c) > 0;
    ASSERT_TRUE(is_wanted ? is_listed : !is_listed || !is_anyones) << "cell " << c;
  }
  EXPECT_TRUE(listed.empty()) << "cells that are dead";
}

// At most one of `to_leave_out` free vertices may be in no tile; 0: none.
template <class S>
void expectTiling(Core<S>& core, Tiling<S>& tiling, int64_t to_leave_out = 0) {
  const Topology& mesh = core.window.mesh;
  const std::vector<int> owners = ownersOf(tiling, mesh.vertexEnd());
  int64_t free = 0, left_out = 0;
  for (uint32_t v = 0; v < mesh.vertexEnd(); ++v) {
    ASSERT_LE(owners[v], mesh.isFree(v) ? 1 : 0) << "vertex " << v;
    free += mesh.isFree(v);
    left_out += mesh.isFree(v) && owners[v] == 0;
  }
  EXPECT_LE(left_out * to_leave_out, free);
  EXPECT_TRUE(to_leave_out > 0 || left_out == 0);
  EXPECT_EQ(tiling.looking(), free - left_out);
  EXPECT_EQ(tiling.leavesOut(), left_out > 0);
  Account account;
  Array<uint32_t> room(account);
  std::vector<uint32_t> last_colour(mesh.cellEnd(), 0);  // plus one
  uint32_t colour = 0;
  for (const TilePiece& t : tiling.tiles()) {
    EXPECT_GE(t.colour, colour) << "tiles are not in the order of their colours";
    colour = t.colour;
    expectCellsOfTile(core.window, tiling, t, owners);
    const uint32_t* cells = tiling.listCells(t, room);
    for (size_t i = 0; i < t.cell_count; ++i) {
      uint32_t& last = last_colour[cells[i]];
      ASSERT_NE(last, t.colour + 1) << "two tiles of a colour share a cell";
      last = t.colour + 1;
    }
  }
}

int tiledSide() {
  return slowRun() ? 14 : 36;  // 50000 vertices, more than six tiles
}
SimplifyOptions smallTiles(SimplifyOptions options) {
  if (slowRun()) options.tile_vertices = 600;
  return options;
}

// Some vertices locked, some cells dead; three rounds of cuts, and the first again.
template <class S>
void expectTilings(size_t threads) {
  TestMesh mesh = fullGrid(tiledSide(), tiledSide(), tiledSide());
  for (size_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked.push_back(v % 17 == 0);
  const Tasks tasks(threads);
  SimplifyOptions options = smallTiles(inMode(Mode::kPaper));
  options.tasks = &tasks;
  WholeWindow<S> w(mesh, options);
  Random r(1);
  for (int k = 0; k < 2000; ++k) {
    const uint32_t cell = r.below(w.core.window.cellEnd());
    if (w.core.window.isLive(cell)) w.core.window.mesh.kill(cell);
  }
  Tiling<S> tiling(w.core, w.account);
  for (unsigned round : {0u, 1u, 2u, 3u}) {
    tiling.build(round, std::numeric_limits<float>::infinity());
    EXPECT_GT(tiling.tiles().size(), 4u);
    expectTiling(w.core, tiling);
  }
}
TEST(Tiling, HasEveryFreeVertexOnceWithAllItsCells) {
  expectTilings<float>(1);
  if (!slowRun()) expectTilings<double>(2);
}

// Of all cells, those of the longest chain of tiles of which each waits for the one before.
template <class S>
double longestChain(const Tiling<S>& tiling) {
  size_t cells = 0, longest = 0;
  for (size_t i = 0; i < tiling.tiles().size(); ++i) {
    cells += tiling.tiles()[i].cell_count;
    longest = std::max(longest, tiling.ahead()[i]);
  }
  return static_cast<double>(longest) / static_cast<double>(cells);
}

// A cube's eight tiles all meet in its middle, and along its edges.
TEST(Tiling, ToBeWorkedOnTogetherLeavesOutTheFewVerticesWhereTilesHardlyMeet) {
  const Tasks tasks(2);
  SimplifyOptions options = inMode(Mode::kSweep);
  options.tasks = &tasks;
  const int side = slowRun() ? 18 : 28;
  if (slowRun()) options.tile_vertices = 900;
  WholeWindow<double> w(fullGrid(side, side, side), options);
  Tiling<double> tiling(w.core, w.account);
  const float all = std::numeric_limits<float>::infinity();
  for (unsigned round = 0; round < (slowRun() ? 1 : 3); ++round) {
    tiling.build(round, all);
    ASSERT_GE(tiling.tiles().size(), 8u);
    expectTiling(w.core, tiling);
    EXPECT_FALSE(tiling.leavesOut());
    const double waiting = longestChain(tiling);
    tiling.build(round, all, TileLayout::kApart);
    expectTiling(w.core, tiling, slowRun() ? 10 : 25);
    EXPECT_TRUE(tiling.leavesOut());
    EXPECT_LT(longestChain(tiling), waiting) << "round " << round;
    EXPECT_LT(longestChain(tiling), 0.55) << "round " << round;
  }
}

// What is left out is the same for any number of threads.
TEST(Tiling, OfFewVerticesIsOfSmallerTilesWhereOthersComeBackToTheirSeams) {
  std::vector<int> first;
  for (size_t threads : {1u, 2u}) {
    const Tasks tasks(threads);
    SimplifyOptions options = inMode(Mode::kSweep);
    options.tasks = &tasks;
    WholeWindow<float> w(fullGrid(20, 20, 16), options);  // 7497 vertices
    Tiling<float> tiling(w.core, w.account);
    const float all = std::numeric_limits<float>::infinity();
    tiling.build(0, all, TileLayout::kApart);
    EXPECT_EQ(tiling.tiles().size(), 2u);
    tiling.build(0, all, TileLayout::kPieces);
    EXPECT_EQ(tiling.tiles().size(), 8u);
    std::vector<int> owners = ownersOf(tiling, w.core.window.mesh.vertexEnd());
    if (threads == 1) first = owners;
    EXPECT_TRUE(owners == first);
    if (threads == 1 || !slowRun()) expectTiling(w.core, tiling, 10);
  }
}

// What is a seam in one round is inside a tile of another.
TEST(Tiling, CutsElsewhereInEachRound) {
  WholeWindow<float> w(fullGrid(tiledSide(), tiledSide(), tiledSide()),
                       smallTiles(inMode(Mode::kPaper)));
  Tiling<float> tiling(w.core, w.account);
  const auto seam = [&](unsigned round) {
    tiling.build(round, std::numeric_limits<float>::infinity());
    std::vector<int> tiles(w.core.window.cellEnd(), 0);
    Array<uint32_t> room(w.account);
    for (const TilePiece& t : tiling.tiles()) {
      const uint32_t* cells = tiling.listCells(t, room);
      for (size_t i = 0; i < t.cell_count; ++i) ++tiles[cells[i]];
    }
    return tiles;
  };
  const auto a = seam(0), b = seam(1), c = seam(2);
  size_t one = 0, all = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    one += a[i] > 1;
    all += a[i] > 1 && b[i] > 1 && c[i] > 1;
  }
  EXPECT_GT(one, 0u);
  EXPECT_LT(all, one / 4);
}

// Most vertices are in the layer that came last, the others far below. Cut across the longest side
// of the box, as what is held whole, the layer would be in slabs, with more cells in several tiles.
TEST(Tiling, OfAStreamCutsTheLayerThatCameLastAcross) {
  SimplifyOptions options = inMode(Mode::kSweep);
  options.tile_vertices = 300;
  WholeWindow<float> w(fullGrid(24, 24, 8), options);
  for (uint32_t v = 0; v < w.core.window.mesh.vertexEnd(); ++v) {
    float& z = w.core.window.values(v)[2];
    if (z < 3) z -= 40 * (3 - z);
  }
  Tiling<float> tiling(w.core, w.account);
  const auto listed = [&](int64_t window_cells) {
    w.core.report.window_cells = window_cells;
    tiling.build(0, std::numeric_limits<float>::infinity());
    expectTiling(w.core, tiling);
    size_t cells = 0;
    for (const TilePiece& tile : tiling.tiles()) cells += tile.cell_count;
    return static_cast<double>(cells);
  };
  const int64_t all = w.core.report.window_cells;
  EXPECT_LT(listed(all - 1), 0.85 * listed(all));
}

// As slices, every other of which is of one colour.
TEST(Tiling, OfFewVerticesHasTilesThatLieApartWhereTheyAreToBeWorkedOnTogether) {
  WholeWindow<double> w(fullGrid(24, 8, 8));
  Tiling<double> tiling(w.core, w.account);
  const float all = std::numeric_limits<float>::infinity();
  tiling.build(0, all);
  EXPECT_EQ(tiling.tiles().size(), 1u);
  for (unsigned round : {0u, 1u, 2u}) {
    tiling.build(round, all, TileLayout::kSlices);
    EXPECT_EQ(tiling.tiles().size(), round % 2 ? 5u : 4u);
    EXPECT_EQ(tiling.tiles().back().colour, 1u);
    expectTiling(w.core, tiling);
  }
}

TEST(Tiling, OfNoFreeVerticesIsEmpty) {
  TestMesh mesh = fullGrid(2, 2, 2);
  mesh.locked.assign(mesh.vertexCount(), 1);
  WholeWindow<double> w(mesh);
  Tiling<double> tiling(w.core, w.account);
  tiling.build(0, std::numeric_limits<float>::infinity());
  EXPECT_TRUE(tiling.tiles().empty());
}

// Places of no extent, and places so far from each other that float32 holds no difference.
TEST(Tiling, CutsWhereAllPlacesAreEqualOrTheirDifferenceOverflows) {
  for (double size : {0.0, 1e300}) {
    WholeWindow<double> w(fullGrid(slowRun() ? 5 : 14, 14, 14));
    for (uint32_t v = 0; v < w.core.window.mesh.vertexEnd(); ++v)
      for (int i = 0; i < 3; ++i) w.core.window.values(v)[i] *= size;
    Tiling<double> tiling(w.core, w.account);
    tiling.build(1, std::numeric_limits<float>::infinity());
    expectTiling(w.core, tiling);
  }
}

}  // namespace
}  // namespace tetstream::test
