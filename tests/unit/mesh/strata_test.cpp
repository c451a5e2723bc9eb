// Conditions on sheets and curves, on meshes small enough to draw, and the set of curves.
#include "strata.h"

#include <gtest/gtest.h>
#include <array>

#include "curves.h"
#include "faces.h"
#include "shapes.h"
#include "vertex_pair.h"

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
  // Labels the faces in the plane z = 3 whose middle is chosen, and makes their rim a curve.
  void addSheet(const std::function<bool(double x, double y)>& chosen) {
    std::map<std::pair<uint32_t, uint32_t>, int> round;
    for (const auto& [face, cells] : facesOf(mesh.cells)) {
      double middle[2] = {0, 0};
      bool in_plane = true;
      for (int64_t v : face) {
        in_plane = in_plane && mesh.position(static_cast<size_t>(v), 2) == 3;
        for (int i = 0; i < 2; ++i) middle[i] += mesh.position(static_cast<size_t>(v), i) / 3;
      }
      if (!in_plane || !chosen(middle[0], middle[1])) continue;
      sheet.push_back(face);
      for (size_t j = 0; j < 3; ++j) {
        topology.flagVertex(static_cast<uint32_t>(face[j]), kInterface);
        ++round[{static_cast<uint32_t>(face[j == 0]), static_cast<uint32_t>(face[j == 2 ? 1 : 2])}];
      }
    }
    for (const auto& [edge, faces] : round)
      if (faces == 1) curves.add(edge.first, edge.second);
  }
  std::vector<uint64_t> linksOf(uint32_t v) const {
    std::vector<uint64_t> links;
    for (const Face& face : sheet) {
      std::vector<uint32_t> others;
      for (int64_t x : face)
        if (x != v) others.push_back(static_cast<uint32_t>(x));
      if (others.size() == 2) links.push_back(pairOf(others[0], others[1]));
    }
    std::sort(links.begin(), links.end());
    return links;
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
    const StrataCondition::Labelled faces = {linksOf(u), linksOf(v)};
    const bool in_labelled = holdsVertex(faces.u, v);
    const bool may = StrataCondition::mayHold(end(u), end(v), stars.ring, e, in_labelled);
    condition.list(end(u), end(v), stars, flags.data(), e, faces);
    const bool does = condition.holds(end(u), end(v), e);
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
  std::vector<Face> sheet;
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

bool inSquare(double x, double y) {
  return x > 1 && x < 5 && y > 1 && y < 5;
}
int64_t oneRegion(double, double, double) {
  return 0;
}

// A square in a region: its vertices are merged in it, onto its rim and along that.
TEST(StrataCondition, LetsASheetEndInARegion) {
  Labelled k(6, oneRegion);
  k.addSheet(inSquare);
  EXPECT_EQ(k.sheet.size(), 32u);
  EXPECT_TRUE(k.holds(k.at(2, 2, 3), k.at(3, 2, 3)));
  EXPECT_TRUE(k.holds(k.at(2, 2, 3), k.at(2, 1, 3)));
  EXPECT_TRUE(k.holds(k.at(2, 1, 3), k.at(2, 2, 3)));
  EXPECT_TRUE(k.holds(k.at(2, 1, 3), k.at(3, 1, 3)));
  EXPECT_TRUE(k.holds(k.at(2, 1, 3), k.at(2, 1, 4)));
  EXPECT_TRUE(k.holds(k.at(3, 3, 3), k.at(3, 3, 2)));
  // At the corner that a single triangle fills two edges of the rim are in one face.
  EXPECT_TRUE(k.holds(k.at(1, 5, 3), k.at(2, 5, 3)) && k.holds(k.at(1, 5, 3), k.at(1, 4, 3)));
}

// Across a strip of one cube's width, and across the neck between two holes: the edges there are in
// the sheet, not on its rim.
TEST(StrataCondition, ForbidsWhatWouldPinchASheet) {
  Labelled strip(6, oneRegion);
  strip.addSheet([](double x, double y) { return inSquare(x, y) && y > 2 && y < 3; });
  EXPECT_FALSE(strip.holds(strip.at(3, 2, 3), strip.at(3, 3, 3)));
  EXPECT_TRUE(strip.holds(strip.at(2, 2, 3), strip.at(3, 2, 3)));
  Labelled neck(6, oneRegion);
  neck.addSheet([](double x, double y) {
    const bool in_hole = y > 2 && y < 3 && ((x > 2 && x < 3) || (x > 4 && x < 5));
    return x > 1 && y > 1 && y < 4 && !in_hole;
  });
  EXPECT_FALSE(neck.holds(neck.at(3, 2, 3), neck.at(4, 2, 3)));
  EXPECT_TRUE(neck.holds(neck.at(3, 2, 3), neck.at(3, 3, 3)));
}

// A fold of the boundary is a curve that may lead across a strip, from one stretch of its rim to
// another; what ends in the rim, or in nothing, is merged along it.
TEST(StrataCondition, ForbidsPinchingASheetAlongAFold) {
  Labelled strip(6, oneRegion);
  strip.addSheet([](double x, double y) { return inSquare(x, y) && y > 2 && y < 3; });
  strip.curves.add(strip.at(3, 2, 3), strip.at(3, 3, 3), true);
  EXPECT_FALSE(strip.holds(strip.at(3, 2, 3), strip.at(3, 3, 3)));
  EXPECT_TRUE(strip.holds(strip.at(3, 2, 3), strip.at(4, 2, 3)));
  Labelled wide(6, oneRegion);
  wide.addSheet(inSquare);
  for (int y = 1; y < 4; ++y) wide.curves.add(wide.at(3, y, 3), wide.at(3, y + 1, 3), true);
  EXPECT_TRUE(wide.holds(wide.at(3, 2, 3), wide.at(3, 1, 3)));
  EXPECT_TRUE(wide.holds(wide.at(3, 2, 3), wide.at(3, 3, 3)));
}

// A triangle stays: each of its edges is the one that is left of two if it went.
TEST(StrataCondition, KeepsASingleFace) {
  Labelled k(6, oneRegion);
  k.addSheet([](double x, double y) { return x > 2 && x < 3 && y > 2 && y < 3 && x > y; });
  ASSERT_EQ(k.sheet.size(), 1u);
  for (size_t i = 0; i < 3; ++i)
    EXPECT_FALSE(k.holds(static_cast<uint32_t>(k.sheet[0][i]),
                         static_cast<uint32_t>(k.sheet[0][(i + 1) % 3])));
  const uint32_t corner = k.at(3, 2, 3), beside = k.at(4, 2, 3);
  EXPECT_TRUE(k.holds(corner, beside) && k.holds(beside, corner));
}

// Two sheets one above the other: what joins them is in neither.
TEST(StrataCondition, KeepsSheetsApart) {
  Labelled k(6, [](double, double, double z) { return z > 4; });
  k.addSheet(inSquare);
  EXPECT_FALSE(k.holds(k.at(3, 3, 3), k.at(3, 3, 4)));
  EXPECT_FALSE(k.holds(k.at(1, 3, 3), k.at(1, 3, 4)));
  EXPECT_TRUE(k.holds(k.at(3, 3, 3), k.at(3, 3, 2)));
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
