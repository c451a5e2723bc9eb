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

template <class S>
void expectCellsOfTile(const Window<S>& window, Tiling<S>& tiling, const TilePiece& tile) {
  std::vector<bool> owned(window.mesh.vertexEnd(), false);
  for (size_t i = 0; i < tile.vertexCount(); ++i) owned[tiling.vertices(tile)[i]] = true;
  std::set<uint32_t> listed;
  Account account;
  Array<uint32_t> room(account);
  const uint32_t* cells = tiling.listCells(tile, room);
  for (size_t i = 0; i < tile.cell_count; ++i)
    EXPECT_TRUE(listed.insert(cells[i]).second) << "a cell twice in a tile";
  EXPECT_TRUE(std::is_sorted(cells, cells + tile.cell_count));
  std::set<uint32_t> wanted;
  for (uint32_t c = 0; c < window.cellEnd(); ++c) {
    if (!window.isLive(c)) continue;
    for (uint32_t j = 0; j < 4; ++j)
      if (owned[window.vertexOf(c, j)]) wanted.insert(c);
  }
  EXPECT_TRUE(listed == wanted);
}

template <class S>
void expectTiling(Core<S>& core, Tiling<S>& tiling) {
  const Topology& mesh = core.window.mesh;
  const std::vector<int> owners = ownersOf(tiling, mesh.vertexEnd());
  for (uint32_t v = 0; v < mesh.vertexEnd(); ++v)
    ASSERT_EQ(owners[v], mesh.isFree(v) ? 1 : 0) << "vertex " << v;
  Account account;
  Array<uint32_t> room(account);
  std::vector<uint32_t> last_colour(mesh.cellEnd(), 0);  // plus one
  uint32_t colour = 0;
  for (const TilePiece& t : tiling.tiles()) {
    EXPECT_GE(t.colour, colour) << "tiles are not in the order of their colours";
    colour = t.colour;
    expectCellsOfTile(core.window, tiling, t);
    const uint32_t* cells = tiling.listCells(t, room);
    for (size_t i = 0; i < t.cell_count; ++i) {
      uint32_t& last = last_colour[cells[i]];
      ASSERT_NE(last, t.colour + 1) << "two tiles of a colour share a cell";
      last = t.colour + 1;
    }
  }
}

int side() {
  return slowRun() ? 22 : 36;  // 50000 vertices, more than six tiles
}

// Some vertices locked, some cells dead; three rounds of cuts, and the first again.
template <class S>
void expectTilings(size_t threads) {
  TestMesh mesh = fullGrid(side(), side(), side());
  for (size_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked.push_back(v % 17 == 0);
  const Tasks tasks(threads);
  SimplifyOptions options = inMode(Mode::kPaper);
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
    EXPECT_GT(tiling.tiles().size(), slowRun() ? 1u : 4u);
    expectTiling(w.core, tiling);
  }
}
TEST(Tiling, HasEveryFreeVertexOnceWithAllItsCells) {
  expectTilings<float>(1);
  if (!slowRun()) expectTilings<double>(2);
}

// What is a seam in one round is inside a tile of another.
TEST(Tiling, CutsElsewhereInEachRound) {
  WholeWindow<float> w(fullGrid(side(), side(), side()));
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

// As slices, every other of which is of one colour.
TEST(Tiling, OfFewVerticesHasTilesThatLieApartWhereTheyAreToBeWorkedOnTogether) {
  WholeWindow<double> w(fullGrid(24, 8, 8));
  Tiling<double> tiling(w.core, w.account);
  const float all = std::numeric_limits<float>::infinity();
  tiling.build(0, all);
  EXPECT_EQ(tiling.tiles().size(), 1u);
  for (unsigned round : {0u, 1u, 2u}) {
    tiling.build(round, all, true);
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
