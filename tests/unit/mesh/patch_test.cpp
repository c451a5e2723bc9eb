// Patches of a window against the window itself: what is loaded, gathered, merged and put back.
#include "patch.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <set>

#include "random.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

constexpr WindowShape kShape = {5, 11, 1, 1, 0};

// A mesh in a window with links, every third cell negative, all of its numbers different.
template <class S>
struct Whole {
  explicit Whole(const TestMesh& mesh)
      : window(account, kShape, mesh.cellCount(), mesh.vertexCount(), true), stars(account) {
    for (uint32_t v = 0; v < mesh.vertexCount(); ++v) {
      window.mesh.addVertex(v % 5 ? kFinal : kFinal | kBoundary);
      for (int i = 0; i < kShape.values; ++i)
        window.values(v)[i] = i < 3 ? static_cast<S>(mesh.position(v, i)) : number();
      for (int i = 0; i < kShape.quadric; ++i) window.quadric(v)[i] = number();
    }
    for (size_t c = 0; c < mesh.cellCount(); ++c) {
      uint32_t corners[4];
      for (size_t j = 0; j < 4; ++j) corners[j] = static_cast<uint32_t>(mesh.cells[4 * c + j]);
      if (c % 3 == 1) std::swap(corners[0], corners[2]);
      window.mesh.addCell(corners, c % 3 == 1 ? kNegative : 0);
    }
  }
  S number() { return static_cast<S>(++numbers); }
  void merge(uint32_t u, uint32_t v) {
    window.gather(u, v, stars.u, stars.ring);
    window.gather(v, u, stars.v, stars.ring_from_v);
    window.merge(u, v, stars);
  }
  std::vector<uint32_t> cellsOf(const std::vector<uint32_t>& owned) {
    const std::set<uint32_t> chosen(owned.begin(), owned.end());
    std::vector<uint32_t> cells;
    for (uint32_t c = 0; c < window.cellEnd(); ++c) {
      bool touched = false;
      for (uint32_t j = 0; j < 4; ++j) touched |= chosen.count(window.vertexOf(c, j)) > 0;
      if (touched) cells.push_back(c);
    }
    return cells;
  }
  Account account;
  Window<S> window;
  Stars stars;
  int numbers = 0;
};

std::vector<uint32_t> someOf(uint32_t count, Random& r, uint32_t of_ten) {
  std::vector<uint32_t> chosen;
  for (uint32_t v = 0; v < count; ++v)
    if (r.below(10) < of_ten) chosen.push_back(v);
  return chosen;
}

// Everything that a window holds.
template <class S>
std::vector<double> contentsOf(Window<S>& w) {
  std::vector<double> all;
  for (uint32_t c = 0; c < w.cellEnd(); ++c) {
    all.push_back(w.mesh.cellFlags(c));
    for (uint32_t j = 0; j < 4 && w.isLive(c); ++j) all.push_back(w.vertexOf(c, j));
  }
  for (uint32_t v = 0; v < w.mesh.vertexEnd(); ++v) {
    all.push_back(w.mesh.vertexFlags(v));
    if (w.mesh.vertexFlags(v) & kCollapsed) continue;
    for (int i = 0; i < kShape.values; ++i) all.push_back(static_cast<double>(w.values(v)[i]));
    for (int i = 0; i < kShape.quadric; ++i) all.push_back(static_cast<double>(w.quadric(v)[i]));
  }
  all.push_back(static_cast<double>(w.liveCells()));
  return all;
}

template <class S>
void expectLoadAndStoreChangeNothing() {
  Random r(1);
  Whole<S> w(fullGrid(4, 4, 4));
  Patch<S> patch(w.account, w.window);
  const auto before = contentsOf(w.window);
  for (int round = 0; round < 10; ++round) {
    const auto owned = someOf(w.window.mesh.vertexEnd(), r, static_cast<uint32_t>(round));
    const auto cells = w.cellsOf(owned);
    ASSERT_TRUE(
        patch.load(owned.data(), owned.size(), cells.data(), cells.size(), w.window.liveCells()));
    EXPECT_EQ(patch.ownedEnd(), owned.size());
    EXPECT_EQ(patch.cellEnd(), cells.size());
    for (uint32_t v = 0; v < owned.size(); ++v) EXPECT_EQ(patch.slotOf(v), owned[v]);
    patch.store();
    EXPECT_TRUE(contentsOf(w.window) == before);
  }
}
TEST(Patch, LeavesTheWindowAsItWasIfNothingIsDone) {
  expectLoadAndStoreChangeNothing<float>();
  expectLoadAndStoreChangeNothing<double>();
}

// The triangles of a star as slots of the window, each turned so that its lowest comes first.
template <class Mesh>
std::set<std::array<uint32_t, 3>> trianglesOf(const Mesh& mesh, const Star& star) {
  std::set<std::array<uint32_t, 3>> all;
  for (const StarCell& s : star) {
    std::array<uint32_t, 3> t = {mesh.slotOf(s.t[0]), mesh.slotOf(s.t[1]), mesh.slotOf(s.t[2])};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    EXPECT_TRUE(all.insert(t).second);
  }
  return all;
}

template <class S>
void expectSameStar(Patch<S>& patch, Whole<S>& w, uint32_t v, uint32_t other) {
  Star star(w.account), ring(w.account);
  patch.gather(v, other, star, ring);
  for (const Star* part : {&star, &ring})
    for (const StarCell& s : *part) {
      EXPECT_TRUE(patch.vertexOf(s.cell, 0) == v || patch.vertexOf(s.cell, 1) == v ||
                  patch.vertexOf(s.cell, 2) == v || patch.vertexOf(s.cell, 3) == v);
      EXPECT_EQ(s.has(other), part == &ring);
    }
  w.window.gather(patch.slotOf(v), patch.slotOf(other), w.stars.u, w.stars.ring);
  EXPECT_EQ(trianglesOf(patch, star), trianglesOf(w.window, w.stars.u));
  EXPECT_EQ(trianglesOf(patch, ring), trianglesOf(w.window, w.stars.ring));
}

// Of each vertex on the boundary the cells with an owned vertex.
template <class S>
void expectBoundaryStars(Patch<S>& patch, Whole<S>& w) {
  Star star(w.account), kept(w.account);
  std::set<uint32_t> owned;
  for (uint32_t v = 0; v < patch.ownedEnd(); ++v) owned.insert(patch.slotOf(v));
  for (uint32_t v = 0; v < patch.vertexEnd(); ++v) {
    if (!patch.isBoundary(v) || (patch.allFlags()[v] & kCollapsed)) continue;
    EXPECT_TRUE(patch.gatherOnBoundary(v, 1000, star));
    EXPECT_TRUE(w.window.gatherOnBoundary(patch.slotOf(v), 1000, w.stars.u));
    kept.clear();
    for (const StarCell& s : w.stars.u)
      if (owned.count(patch.slotOf(v)) || owned.count(s.t[0]) || owned.count(s.t[1]) ||
          owned.count(s.t[2]))
        kept.add() = s;
    EXPECT_EQ(trianglesOf(patch, star), trianglesOf(w.window, kept));
    const size_t cells = kept.size();
    EXPECT_FALSE(cells > 0 && patch.gatherOnBoundary(v, cells - 1, star));
    EXPECT_FALSE(w.stars.u.size() > 0 &&
                 w.window.gatherOnBoundary(patch.slotOf(v), w.stars.u.size() - 1, star));
  }
}

TEST(Patch, GathersWhatTheWindowDoes) {
  Random r(2);
  Whole<float> w(fullGrid(4, 4, 4));
  w.window.mesh.kill(17);  // dead cells may be among those that are given
  w.window.mesh.kill(100);
  Patch<float> patch(w.account, w.window);
  const auto owned = someOf(w.window.mesh.vertexEnd(), r, 5);
  const auto cells = w.cellsOf(owned);
  ASSERT_TRUE(
      patch.load(owned.data(), owned.size(), cells.data(), cells.size(), w.window.liveCells()));
  EXPECT_LE(patch.cellEnd(), cells.size());
  for (uint32_t v = 0; v < patch.ownedEnd(); ++v) {
    EXPECT_EQ(patch.isBoundary(v), patch.slotOf(v) % 5 == 0);
    for (int k = 0; k < 3; ++k) {
      const uint32_t other = r.below(patch.vertexEnd());  // of the rim, or far, too
      if (other != v) expectSameStar(patch, w, v, other);
    }
  }
  patch.store();
}

// Two windows, one merged in place, the other in a patch, edge by edge, legal or not.
template <class S>
struct Twins {
  explicit Twins(const TestMesh& mesh)
      : a(mesh), b(mesh), patch(b.account, b.window), stars(b.account) {}
  void load(const std::vector<uint32_t>& owned) {
    const auto cells = b.cellsOf(owned);
    ASSERT_TRUE(
        patch.load(owned.data(), owned.size(), cells.data(), cells.size(), b.window.liveCells()));
  }
  // By place in the patch.
  void merge(uint32_t u, uint32_t v) {
    patch.gather(u, v, stars.u, stars.ring);
    patch.gather(v, u, stars.v, stars.ring_from_v);
    EXPECT_EQ(stars.ring.size(), stars.ring_from_v.size());
    patch.merge(u, v, stars);
    a.merge(patch.slotOf(u), patch.slotOf(v));
    EXPECT_EQ(patch.liveCells(), a.window.liveCells());
    const S moved = a.number();
    patch.values(u)[1] = patch.quadric(u)[3] = moved;
    a.window.values(patch.slotOf(u))[1] = a.window.quadric(patch.slotOf(u))[3] = moved;
  }
  // An edge between two owned vertices that are left; false if there is none.
  bool findEdge(Random& r, uint32_t* u, uint32_t* v) {
    for (uint32_t tries = 0; tries < 3 * patch.cellEnd(); ++tries) {
      const uint32_t c = r.below(patch.cellEnd()), i = r.below(4), j = (i + 1 + r.below(3)) % 4;
      if (!patch.isLive(c)) continue;
      *u = patch.vertexOf(c, i), *v = patch.vertexOf(c, j);
      if (patch.isFree(*u) && patch.isFree(*v)) return true;
    }
    return false;
  }
  Whole<S> a, b;
  Patch<S> patch;
  Stars stars;
};

TEST(Patch, MergesAsTheWindowDoes) {
  for (uint64_t seed = 0; seed < (slowRun() ? 2u : 12u); ++seed) {
    Random r(seed);
    Twins<double> t(fullGrid(4, 4, 4));
    for (int patches = 0; patches < 3; ++patches) {  // one after another, in what is left
      std::vector<uint32_t> owned;
      for (uint32_t v : someOf(t.a.window.mesh.vertexEnd(), r, 6))
        if (t.b.window.isFree(v)) owned.push_back(v);
      t.load(owned);
      uint32_t u = 0, v = 0;
      for (int k = 0; k < 15 && t.findEdge(r, &u, &v); ++k) {
        t.merge(u, v);
        expectSameStar(t.patch, t.a, u, (u + 1 + r.below(5)) % t.patch.vertexEnd());
        expectBoundaryStars(t.patch, t.a);
      }
      t.patch.store();
      ASSERT_TRUE(contentsOf(t.a.window) == contentsOf(t.b.window));
    }
  }
}

// One vertex takes its neighbours one by one: each time its list is written anew, behind all
// others, until there is no room and those that are left are moved.
TEST(Patch, KeepsItsListsThroughAnyNumberOfMerges) {
  const int n = slowRun() ? 4 : 8;
  Twins<float> t(fullGrid(n, n, n));
  std::vector<uint32_t> owned;
  for (uint32_t v = 0; v < t.b.window.mesh.vertexEnd(); ++v) owned.push_back(v);
  t.load(owned);
  size_t written = 0;
  const uint32_t hub = t.patch.ownedEnd() / 2;
  Star star(t.b.account), ring(t.b.account);
  for (;;) {
    t.patch.gather(hub, kNone, star, ring);
    if (star.size() == 0) break;
    t.merge(hub, star[star.size() / 2].t[0]);
    t.patch.gather(hub, kNone, star, ring);
    written += star.size();
  }
  EXPECT_GT(written, slowRun() ? 0u : 4 * 2 * 4 * t.b.window.cellEnd());  // the room, four times
  t.patch.store();
  EXPECT_TRUE(contentsOf(t.a.window) == contentsOf(t.b.window));
}

TEST(Patch, RefusesWhatIsTooLargeAndIsAsBeforeThen) {
  const size_t count = 17000;  // cells that share nothing: more vertices than 16 bits number
  Account account;
  Window<float> window(account, kShape, Patch<float>::kMostCells + 1, 4 * count, true);
  std::vector<uint32_t> cells;
  for (uint32_t c = 0; c < count; ++c) {
    uint32_t corners[4];
    for (uint32_t& v : corners) {
      v = window.mesh.addVertex(kFinal);
      std::fill_n(window.values(v), kShape.values, static_cast<float>(v));
      std::fill_n(window.quadric(v), kShape.quadric, static_cast<float>(v));
    }
    cells.push_back(window.mesh.addCell(corners, 0));
  }
  const auto before = contentsOf(window);
  Patch<float> patch(account, window);
  const uint32_t first[4] = {0, 1, 2, 3};
  EXPECT_FALSE(patch.load(first, 4, cells.data(), cells.size(), window.liveCells()));
  EXPECT_TRUE(contentsOf(window) == before);
  // The same cell again and again is as many cells.
  const std::vector<uint32_t> many(Patch<float>::kMostCells + 1, 0);
  EXPECT_FALSE(patch.load(first, 4, many.data(), many.size(), window.liveCells()));
  ASSERT_TRUE(patch.load(first, 4, cells.data() + 0, 1, window.liveCells()));
  EXPECT_EQ(patch.vertexEnd(), 4u);
  EXPECT_EQ(patch.slotOf(2), 2u);
  patch.store();
  EXPECT_TRUE(contentsOf(window) == before);
}

// Slots that came since the patch was last loaded.
TEST(Patch, FollowsAGrowingWindow) {
  const TestMesh mesh = fullGrid(2, 2, 2);
  Whole<double> w(mesh);
  Patch<double> patch(w.account, w.window);
  const uint32_t old[2] = {0, 1};
  const auto cells = w.cellsOf({0, 1});
  ASSERT_TRUE(patch.load(old, 2, cells.data(), cells.size(), w.window.liveCells()));
  patch.store();
  w.window.growVertices(mesh.vertexCount() + 1000);
  w.window.growCells(mesh.cellCount() + 10);
  uint32_t corners[4] = {0, 1, 2, 0};
  for (int k = 0; k < 1000; ++k) corners[3] = w.window.mesh.addVertex(kFinal);
  std::fill_n(w.window.values(corners[3]), kShape.values, 1.0);
  std::fill_n(w.window.quadric(corners[3]), kShape.quadric, 2.0);
  const uint32_t cell = w.window.mesh.addCell(corners, 0);
  ASSERT_TRUE(patch.load(&corners[3], 1, &cell, 1, w.window.liveCells()));
  Star star(w.account), ring(w.account);
  patch.gather(0, kNone, star, ring);
  ASSERT_EQ(star.size(), 1u);
  EXPECT_EQ(patch.slotOf(star[0].t[0]) + patch.slotOf(star[0].t[1]) + patch.slotOf(star[0].t[2]),
            3u);
  patch.store();
}

}  // namespace
}  // namespace tetstream::test
