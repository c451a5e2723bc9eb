// Flips of a few cells: the same space by other cells, and what is left alone.
#include "reconnect.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "random.h"
#include "test_mesh.h"
#include "vector3.h"

namespace tetstream::test {
namespace {

using Point = std::array<double, 3>;
using Corners = std::array<uint32_t, 4>;

// Cells by their corners, all vertices free unless said otherwise, in a patch that owns those but
// the ones that are another's.
struct Pieces {
  Pieces(const std::vector<Point>& points, const std::vector<Corners>& cells,
         const std::set<uint32_t>& locked = {}, const std::set<uint32_t>& others = {})
      : window(account, {3, 1, 0, 0, 0}, cells.size(), points.size(), true),
        patch(account, window),
        reconnector(patch, account) {
    std::vector<uint32_t> owned, all;
    for (uint32_t v = 0; v < points.size(); ++v) {
      window.mesh.addVertex(locked.count(v) ? kFinal | kLocked : kFinal);
      std::copy(points[v].begin(), points[v].end(), window.values(v));
      window.quadric(v)[0] = 0;
      if (!locked.count(v) && !others.count(v)) owned.push_back(v);
    }
    for (const Corners& c : cells) all.push_back(window.mesh.addCell(c.data(), 0));
    for (uint32_t c = 0; c < all.size(); ++c)
      if (sixVolumeOf(corners(c)) < 0) window.mesh.flagCell(c, kNegative);
    loaded = patch.load(owned.data(), owned.size(), all.data(), all.size(), window.liveCells());
    patch.listGone();
    reconnector.start(false);
  }
  Corners corners(uint32_t c) const {
    Corners all;
    std::copy_n(window.mesh.corners(c), 4, all.begin());
    return all;
  }
  double sixVolumeOf(const Corners& corners) const {
    double p[4][3];
    for (size_t k = 0; k < 4; ++k) std::copy_n(window.values(corners[k]), 3, p[k]);
    return sixVolume(p);
  }
  // By slots of the window.
  uint32_t inPatch(uint32_t slot) const {
    for (uint32_t v = 0; v < patch.vertexEnd(); ++v)
      if (patch.slotOf(v) == slot) return v;
    return kNone;
  }
  bool removeEdge(uint32_t u, uint32_t v, Reconnection& r, double least_gain = 0) {
    for (uint32_t c = 0; c < patch.cellEnd(); ++c)
      for (uint32_t i = 0; i < 4; ++i)
        for (uint32_t j = 0; j < 4; ++j)
          if (patch.vertexOf(c, i) == inPatch(u) && patch.vertexOf(c, j) == inPatch(v))
            return reconnector.removeEdge(c, i, j, r, Reconnection::kMostRing, least_gain);
    return false;
  }
  void apply(const Reconnection& r) { reconnector.replace(r, made); }

  Account account;
  Window<double> window;
  Patch<double> patch;
  Reconnector<double> reconnector;
  bool loaded = false;
  uint32_t made[Reconnection::kMostCells];  // the cells of the last flip
};

// Of the live cells of the window between vertices below `end`: volume, outer faces, and whether
// all lie as they say.
struct Look {
  double volume = 0;
  std::set<std::array<uint32_t, 3>> outside;
  std::set<std::set<uint32_t>> cells;
};
Look lookAt(const Pieces& pieces, uint32_t end) {
  Look look;
  std::map<std::array<uint32_t, 3>, int> faces;
  for (uint32_t c = 0; c < pieces.window.cellEnd(); ++c) {
    if (!pieces.window.isLive(c)) continue;
    const Corners v = pieces.corners(c);
    if (*std::max_element(v.begin(), v.end()) >= end) continue;
    const double volume = pieces.sixVolumeOf(v);
    EXPECT_EQ(volume < 0, (pieces.window.mesh.cellFlags(c) & kNegative) != 0);
    look.volume += std::fabs(volume);
    look.cells.insert({v.begin(), v.end()});
    for (size_t j = 0; j < 4; ++j) {
      std::array<uint32_t, 3> face;
      for (size_t k = 0; k < 3; ++k) face[k] = v[kOpposite[j][k]];
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  }
  for (const auto& [face, count] : faces) {
    EXPECT_LE(count, 2);
    if (count == 1) look.outside.insert(face);
  }
  return look;
}

// Every owned vertex finds the cells that hold it.
void expectStarsToBeRight(Pieces& pieces) {
  Patch<double>& patch = pieces.patch;
  Star none(pieces.account), star(pieces.account);
  for (uint32_t v = 0; v < patch.ownedEnd(); ++v) {
    std::set<uint32_t> found, wanted;
    patch.gather(v, v, none, star);
    for (const StarCell& s : star) EXPECT_TRUE(found.insert(s.cell).second);
    for (uint32_t c = 0; c < patch.cellEnd(); ++c)
      for (uint32_t j = 0; patch.isLive(c) && j < 4; ++j)
        if (patch.vertexOf(c, j) == v) wanted.insert(c);
    EXPECT_EQ(found, wanted) << v;
  }
}

// n cells round the edge 0 1, vertices 2 .. n + 1 round it.
std::vector<Point> ringPoints(uint32_t n, double length, Random& r, double noise) {
  const auto random = [&] { return noise * (static_cast<double>(r.below(2001)) / 1000 - 1); };
  std::vector<Point> points = {{0, 0, -length / 2}, {0, 0, length / 2}};
  for (uint32_t k = 0; k < n; ++k) {
    const double angle = 2 * std::acos(-1.0) / n * (k + 0.45 * random()), radius = 1 + random() / 2;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), random()});
  }
  return points;
}
std::vector<Point> ringPoints(uint32_t n, double length) {
  Random r(1);
  return ringPoints(n, length, r, 0);
}
std::vector<Corners> ringCells(uint32_t n) {
  std::vector<Corners> cells;
  for (uint32_t k = 0; k < n; ++k) {
    Corners c = {0, 1, 2 + k, 2 + (k + 1) % n};
    if (k % 2) std::swap(c[1], c[3]);  // orders are mixed in the wild
    cells.push_back(c);
  }
  return cells;
}

// Beside, an edge between the last two but six points, with six cells round it.
uint32_t addFarRing(std::vector<Point>& points, std::vector<Corners>& cells) {
  const auto far = static_cast<uint32_t>(points.size());
  for (double x : {20.0, 21.0}) points.push_back({x, 0, 0});
  for (uint32_t k = 0; k < 6; ++k) {
    const double angle = std::acos(-1.0) / 3 * k;
    points.push_back({20.5, std::cos(angle), std::sin(angle)});
    cells.push_back({far, far + 1, far + 2 + k, far + 2 + (k + 1) % 6});
  }
  return far;
}
// Its cells are gone, and their slots are free.
void mergeFarEdge(Pieces& pieces, uint32_t far) {
  Stars stars(pieces.account);
  const uint32_t u = pieces.inPatch(far), v = pieces.inPatch(far + 1);
  pieces.patch.gather(u, v, stars.u, stars.ring);
  pieces.patch.gather(v, u, stars.v, stars.ring_from_v);
  pieces.patch.merge(u, v, stars);
  pieces.patch.listGone();
  EXPECT_EQ(pieces.patch.freeSlots(), 6u);
}

// Does the flip, which improves, and looks at what came of it.
void expectSameSpace(Pieces& pieces, const Reconnection& r, uint32_t end) {
  const Look before = lookAt(pieces, end);
  const int64_t live = pieces.patch.liveCells(), more = int64_t{r.made_count} - r.gone_count;
  EXPECT_EQ(live, static_cast<int64_t>(before.cells.size()));
  EXPECT_LT(r.after, r.before);
  EXPECT_LT(r.after, 1);
  pieces.apply(r);
  double worst = -1;
  for (uint32_t m = 0; m < r.made_count; ++m)
    worst = std::max(worst, pieces.reconnector.thinnessOfCell(pieces.made[m]));
  EXPECT_EQ(worst, r.after);
  expectStarsToBeRight(pieces);
  EXPECT_EQ(pieces.patch.liveCells(), live + more);
  pieces.patch.store();
  const Look after = lookAt(pieces, end);
  EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.volume);
  EXPECT_EQ(after.outside, before.outside);
  EXPECT_EQ(static_cast<int64_t>(after.cells.size()), live + more);
  EXPECT_EQ(int64_t{pieces.window.mesh.liveCells()}, live + more);
}

TEST(Reconnect, AFaceMakesWayForAnEdge) {
  // Two flat cells over a large face: three round the short edge between their tips are better.
  std::vector<Point> points = {
      {0, 0, 0.2}, {1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}, {0, 0, -0.2}};
  std::vector<Corners> cells = {{0, 1, 2, 3}, {4, 1, 2, 3}};
  const uint32_t far = addFarRing(points, cells);
  Pieces pieces(points, cells);
  ASSERT_TRUE(pieces.loaded);
  EXPECT_EQ(pieces.patch.freeSlots(), 0u);
  mergeFarEdge(pieces, far);
  Reconnection r;
  uint32_t above = 4;
  for (uint32_t j = 0; j < 4; ++j)
    if (pieces.patch.slotOf(pieces.patch.vertexOf(0, j)) == 0) above = j;
  ASSERT_TRUE(pieces.reconnector.removeFace(0, above, r));
  EXPECT_EQ(r.gone_count, 2u);
  ASSERT_EQ(r.made_count, 3u);
  expectSameSpace(pieces, r, far);
  EXPECT_EQ(pieces.patch.freeSlots(), 5u);
  for (const auto& cell : lookAt(pieces, far).cells) EXPECT_TRUE(cell.count(0) && cell.count(4));
}

TEST(Reconnect, AFaceOfTheBoundaryStays) {
  Pieces pieces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}});
  Reconnection r;
  for (uint32_t j = 0; j < 4; ++j) EXPECT_FALSE(pieces.reconnector.removeFace(0, j, r));
}

// Random rings, with slots for the cells that come in addition.
// The flip of the edge 01 is found again where no more is asked for than it gains.
void expectGain(Pieces& pieces, const Reconnection& flip) {
  const double gain = flip.before - flip.after;
  Reconnection again;
  ASSERT_TRUE(pieces.removeEdge(0, 1, again, 0.99 * gain));
  EXPECT_EQ(again.after, flip.after);
  EXPECT_EQ(again.made_count, flip.made_count);
  ASSERT_TRUE(pieces.removeEdge(0, 1, again, 1.01 * gain));
  EXPECT_GE(again.after, again.before - 1.01 * gain);
}

TEST(Reconnect, AnEdgeMakesWayForTriangles) {
  Random r(7);
  for (uint32_t n = 3; n <= Reconnection::kMostRing; ++n) {
    int improved = 0;
    for (int tries = 0; tries < 3000 && improved < (slowRun() ? 1 : 10); ++tries) {
      const double length = 0.3 + static_cast<double>(r.below(1000)) / 250;
      std::vector<Point> points = ringPoints(n, length, r, 0.9);
      std::vector<Corners> cells = ringCells(n);
      const uint32_t far = addFarRing(points, cells);
      Pieces pieces(points, cells);
      ASSERT_TRUE(pieces.loaded);
      Reconnection flip;
      if (!pieces.removeEdge(0, 1, flip)) continue;  // two are more than half a turn apart
      EXPECT_EQ(flip.gone_count, n);
      if (!flip.improves()) continue;
      ++improved;
      EXPECT_EQ(flip.made_count, 2 * (n - 2));
      expectGain(pieces, flip);
      mergeFarEdge(pieces, far);
      ASSERT_TRUE(pieces.removeEdge(0, 1, flip));
      expectSameSpace(pieces, flip, far);
      EXPECT_EQ(pieces.patch.freeSlots(), 6 + 4 - n);
      for (const auto& cell : lookAt(pieces, far).cells)
        EXPECT_FALSE(cell.count(0) && cell.count(1));
    }
    EXPECT_GT(improved, 0) << n;
  }
}

TEST(Reconnect, AnOpenOrALargeRingStays) {
  std::vector<Corners> open = ringCells(5);
  open.pop_back();
  Pieces at_boundary(ringPoints(5, 8), open);
  Reconnection r;
  EXPECT_FALSE(at_boundary.removeEdge(0, 1, r));
  Pieces large(ringPoints(8, 8), ringCells(8));
  EXPECT_FALSE(large.removeEdge(0, 1, r));
  Pieces locked(ringPoints(4, 8), ringCells(4), {0, 1});
  EXPECT_FALSE(locked.removeEdge(0, 1, r));  // the stars of vertices that are not owned are unknown
}

// Where the ring is not convex enough, some triangle would make a cell that is turned over.
TEST(Reconnect, NoCellIsTurnedOver) {
  std::vector<Point> points = ringPoints(4, 1);
  points[0][2] = 0.2;  // both ends above the plane of the ring
  points[1][2] = 1;
  Pieces pieces(points, ringCells(4));
  Reconnection r;
  ASSERT_TRUE(pieces.removeEdge(0, 1, r));
  EXPECT_FALSE(r.improves());
}

// Of the first cell, the face opposite its vertex 0.
bool improvesWithoutFace(Pieces& pieces) {
  Reconnection r;
  for (uint32_t j = 0; j < 4; ++j)
    if (pieces.patch.slotOf(pieces.patch.vertexOf(0, j)) == 0) {
      EXPECT_TRUE(pieces.reconnector.removeFace(0, j, r));
      return r.improves();
    }
  return false;
}

// A mesh that folds over itself may have the new edge, or the new face, elsewhere already: then a
// flip would make a face of three cells.
TEST(Reconnect, WhatIsThereAlreadyIsNotMadeAgain) {
  const auto faceImproves = [](bool folded) {
    std::vector<Point> points = {{0, 0, 0.2},  {1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0},
                                 {0, 0, -0.2}, {3, 0, 0}, {0, 3, 0}};
    std::vector<Corners> cells = {{0, 1, 2, 3}, {4, 1, 2, 3}, {1, 2, 5, 6}};
    if (folded) cells.push_back({0, 4, 5, 6});
    Pieces pieces(points, cells);
    return improvesWithoutFace(pieces);
  };
  EXPECT_TRUE(faceImproves(false));
  EXPECT_FALSE(faceImproves(true));

  const auto edgeImproves = [](std::vector<Point> points, const std::vector<Corners>& folded) {
    std::vector<Corners> cells = ringCells(static_cast<uint32_t>(points.size()) - 2);
    for (double x : {3.0, 4.0}) points.push_back({x, 1, 1});
    cells.insert(cells.end(), folded.begin(), folded.end());
    Pieces pieces(points, cells);
    Reconnection r;
    return pieces.removeEdge(0, 1, r) && r.improves();
  };
  EXPECT_TRUE(edgeImproves(ringPoints(3, 8), {{2, 3, 5, 6}}));   // of course a ring has its edges
  EXPECT_FALSE(edgeImproves(ringPoints(3, 8), {{2, 3, 4, 6}}));  // the triangle
  Random r(7);
  int improved = 0;
  for (int tries = 0; tries < 200; ++tries) {
    const std::vector<Point> points = ringPoints(4, 2, r, 0.9);
    improved += edgeImproves(points, {{2, 3, 6, 7}});
    EXPECT_FALSE(edgeImproves(points, {{2, 4, 6, 7}, {3, 5, 6, 7}}));  // both chords
  }
  EXPECT_GT(improved, 0);
}

// Two cells over the face 123, which makes way for the edge 04, and the cell 0456, which has that
// edge already but none of whose corners is owned: it is in no star that the patch knows. Only
// cells that fold, and whose corners are locked, can lie so.
TEST(Reconnect, WhatTheStarsOfFoldedCellsMayHaveIsNotMade) {
  const std::vector<Point> points = {{0, 0, 0.2},  {1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0},
                                     {0, 0, -0.2}, {3, 0, 0}, {0, 3, 0}};
  const auto makesEdge = [&](bool may_repeat, const std::set<uint32_t>& others) {
    std::set<uint32_t> locked;
    for (uint32_t v : {0, 4, 5, 6})
      if (!others.count(v)) locked.insert(v);
    Pieces pieces(points, {{0, 1, 2, 3}, {4, 1, 2, 3}, {0, 4, 5, 6}}, locked, others);
    pieces.reconnector.start(may_repeat);
    return improvesWithoutFace(pieces);
  };
  EXPECT_FALSE(makesEdge(true, {}));
  EXPECT_TRUE(makesEdge(false, {}));  // as for the caller's wish
  EXPECT_TRUE(makesEdge(true, {0}));
}

// The same of the face 234, for which the edge 01 makes way.
TEST(Reconnect, AFaceThatFoldedCellsMayHaveIsNotMade) {
  std::vector<Point> points = ringPoints(3, 8);
  points.push_back({3, 1, 1});
  const auto makesFace = [&](bool may_repeat, const std::set<uint32_t>& others) {
    std::set<uint32_t> locked;
    for (uint32_t v : {2, 3, 4, 5})
      if (!others.count(v)) locked.insert(v);
    std::vector<Corners> cells = ringCells(3);
    cells.push_back({2, 3, 4, 5});
    Pieces pieces(points, cells, locked, others);
    pieces.reconnector.start(may_repeat);
    Reconnection r;
    return pieces.removeEdge(0, 1, r) && r.improves();
  };
  EXPECT_FALSE(makesFace(true, {}));
  EXPECT_TRUE(makesFace(false, {}));
  EXPECT_TRUE(makesFace(true, {3}));
}

}  // namespace
}  // namespace tetstream::test
