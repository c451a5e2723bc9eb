// Conditions on sheets and curves, on meshes small enough to draw, and the set of curves.
#include "strata.h"

#include <gtest/gtest.h>
#include <array>

#include "curves.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

// A grid of n^3 cubes whose cells have a label by their middle.
struct Labelled {
  Labelled(int n, const std::function<int64_t(double, double, double)>& label)
      : mesh(fullGrid(n, n, n)),
        topology(account, mesh.cellCount(), mesh.vertexCount()),
        curves(account),
        stars(account) {
    for (size_t v = 0; v < mesh.vertexCount(); ++v) topology.addVertex(kFinal);
    for (size_t c = 0; c < mesh.cellCount(); ++c) {
      uint32_t corners[4];
      double middle[3] = {0, 0, 0};
      for (size_t j = 0; j < 4; ++j) {
        corners[j] = static_cast<uint32_t>(mesh.cells[4 * c + j]);
        for (int i = 0; i < 3; ++i) middle[i] += mesh.position(corners[j], i) / 4;
      }
      topology.addCell(corners, 0);
      labels.push_back(label(middle[0], middle[1], middle[2]));
    }
    // Vertices inside the grid whose cells have several labels are on an interface.
    for (uint32_t c = 0; c < topology.cellEnd(); ++c)
      for (int j = 0; j < 4; ++j) {
        const uint32_t v = topology.corners(c)[j];
        if (first[v] == kNone) first[v] = c;
        if (labels[first[v]] != labels[c]) topology.flagVertex(v, kInterface);
      }
  }
  Embedded embedded() const {
    Embedded e;
    e.labels = {labels.data(), 1, &column, 1, nullptr};
    e.curves = &curves;
    return e;
  }
  uint32_t at(double x, double y, double z) const {
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
      if (mesh.position(v, 0) == x && mesh.position(v, 1) == y && mesh.position(v, 2) == z)
        return static_cast<uint32_t>(v);
    ADD_FAILURE() << "no vertex there";
    return 0;
  }
  // Both halves of the question; no end is outside.
  bool holds(uint32_t u, uint32_t v) {
    const auto flags = std::vector<uint8_t>(topology.allVertexFlags(),
                                            topology.allVertexFlags() + topology.vertexEnd());
    topology.gather(u, v, stars.u, stars.ring);
    topology.gather(v, u, stars.v, stars.ring_from_v);
    EXPECT_GT(stars.ring.size(), 0u) << "no edge";
    const Embedded e = embedded();
    const auto end = [&](uint32_t x) {
      return StrataCondition::End{x, e.stratumOf(x, flags[x] & kOnSheet), false};
    };
    const bool may = StrataCondition::mayHold(end(u), end(v), stars.ring, e);
    const bool does = condition.holds(end(u), end(v), stars, flags.data(), e);
    EXPECT_TRUE(may || !does) << "the first look refuses what the second allows";
    return does;
  }

  Account account;
  TestMesh mesh;
  Topology topology;
  Curves curves;
  Stars stars;
  StrataCondition condition;
  std::vector<int64_t> labels;
  const int column = 0;
  std::vector<uint32_t> first = std::vector<uint32_t>(1000, kNone);
};

// A plane between two regions.
TEST(StrataCondition, AllowsEdgesInAPlaneSheetAndOntoIt) {
  Labelled k(6, [](double, double, double z) { return z < 3; });
  EXPECT_TRUE(k.holds(k.at(2, 2, 3), k.at(3, 2, 3)));
  EXPECT_TRUE(k.holds(k.at(2, 2, 3), k.at(2, 2, 4)));
  EXPECT_TRUE(k.holds(k.at(2, 2, 2), k.at(2, 2, 3)));
  EXPECT_TRUE(k.holds(k.at(2, 2, 4), k.at(3, 2, 4)));
}

// A layer of one cube's height: an edge through it has both ends on sheets and is in none.
TEST(StrataCondition, ForbidsEdgesThatWouldPierceALayer) {
  Labelled k(6, [](double, double, double z) { return z > 3 && z < 4; });
  EXPECT_FALSE(k.holds(k.at(2, 2, 3), k.at(2, 2, 4)));
  EXPECT_TRUE(k.holds(k.at(2, 2, 3), k.at(3, 2, 3)));
}

// A column whose section is a triangle: three edges of its sheet go round it, and are no face of
// the sheet. Without any of them the column would be cut in two. One whose section is a square has
// an edge to spare.
TEST(StrataCondition, ForbidsWhatWouldPinchAColumn) {
  Labelled k(6, [](double x, double y, double) { return x < 3 && y > 2 && x > y; });
  EXPECT_FALSE(k.holds(k.at(2, 2, 3), k.at(3, 2, 3)));
  EXPECT_FALSE(k.holds(k.at(3, 2, 3), k.at(3, 3, 3)));
  EXPECT_TRUE(k.holds(k.at(2, 2, 3), k.at(2, 2, 2)));
  Labelled square(6, [](double x, double y, double) { return x > 2 && x < 3 && y > 2 && y < 3; });
  EXPECT_TRUE(square.holds(square.at(2, 2, 3), square.at(3, 2, 3)));
}

// Four quarters meet along a line: it is a curve, and its vertices are merged with each other along
// it and with what is in the sheets, but sheets' vertices not across it.
TEST(StrataCondition, KeepsACurve) {
  Labelled k(6, [](double x, double y, double) { return (x > 3) + 2 * (y > 3); });
  for (int z = 0; z < 6; ++z) k.curves.add(k.at(3, 3, z), k.at(3, 3, z + 1));
  EXPECT_TRUE(k.holds(k.at(3, 3, 2), k.at(3, 3, 3)));
  EXPECT_TRUE(k.holds(k.at(3, 2, 3), k.at(3, 3, 3)));
  EXPECT_FALSE(k.holds(k.at(2, 3, 3), k.at(3, 4, 4)) && k.holds(k.at(3, 4, 4), k.at(2, 3, 3)));
  // Two curves' vertices with an edge between that is in a sheet only.
  k.curves.add(k.at(3, 2, 2), k.at(3, 2, 3));
  EXPECT_FALSE(k.holds(k.at(3, 2, 3), k.at(3, 3, 3)));
}

// A curve of three edges in a plane sheet: none of them can go.
TEST(StrataCondition, KeepsASmallRing) {
  Labelled k(6, [](double, double, double z) { return z < 3; });
  const uint32_t a = k.at(2, 2, 3), b = k.at(3, 2, 3), c = k.at(3, 3, 3), d = k.at(2, 3, 3);
  const bool diagonal = [&] {
    k.topology.gather(a, c, k.stars.u, k.stars.ring);
    return k.stars.ring.size() > 0;
  }();
  const uint32_t ring[3] = {diagonal ? a : b, diagonal ? b : c, diagonal ? c : d};
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(k.holds(ring[i], ring[(i + 1) % 3]));
  for (int i = 0; i < 3; ++i) k.curves.add(ring[i], ring[(i + 1) % 3]);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(k.holds(ring[i], ring[(i + 1) % 3]));
}

TEST(Curves, FollowMergersAndPacking) {
  Account account;
  Curves curves(account);
  EXPECT_TRUE(curves.empty());
  for (uint32_t v = 0; v < 1000; ++v) curves.add(v, v + 1);
  curves.add(3, 2);  // known
  EXPECT_TRUE(curves.has(2, 3) && curves.has(3, 2));
  curves.merge(10, 11);  // an edge of it
  EXPECT_TRUE(curves.has(10, 12) && curves.has(9, 10));
  EXPECT_FALSE(curves.has(10, 11) || curves.has(11, 12) || curves.passes(11));
  curves.merge(5000, 20);  // onto a vertex that no curve passed
  EXPECT_TRUE(curves.has(5000, 19) && curves.has(21, 5000));
  std::vector<uint32_t> keep(5001, kNone);
  for (uint32_t v = 15; v < 25; ++v) keep[v] = v - 15;
  keep[5000] = 100;
  curves.remap(keep.data());
  EXPECT_TRUE(curves.has(100, 4) && curves.has(100, 6) && curves.has(0, 1));
  EXPECT_FALSE(curves.passes(9) && curves.has(9, 10));
  for (uint32_t round = 0; round < 1000; ++round)
    curves.merge(100 + (round + 1) % 2, 100 + round % 2);
  EXPECT_TRUE(curves.has(0, 1) && curves.has(100, 4) && curves.has(6, 100));
}

}  // namespace
}  // namespace tetstream::test
