// The link condition: on meshes small enough to draw, and against its definition, evaluated over
// sets of simplices, on random ones.
#include "link.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "mesh_facts.h"
#include "orient.h"
#include "random.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

using Simplex = std::set<int64_t>;
using Simplices = std::set<Simplex>;
constexpr int64_t kCone = -1;  // the point that the boundary is coned to

// All faces of all cells, and the cones over all faces of the boundary.
Simplices coned(const std::vector<int64_t>& cells) {
  Simplices top;
  std::map<Simplex, int> faces;
  for (size_t c = 0; c < cells.size() / 4; ++c) {
    const Simplex cell(&cells[4 * c], &cells[4 * c] + 4);
    top.insert(cell);
    for (int64_t v : cell) {
      Simplex face = cell;
      face.erase(v);
      ++faces[face];
    }
  }
  for (const auto& [face, count] : faces)
    if (count == 1) {
      Simplex cone = face;
      cone.insert(kCone);
      top.insert(cone);
    }
  Simplices all;
  for (const Simplex& s : top) {
    const std::vector<int64_t> v(s.begin(), s.end());
    for (unsigned bits = 1; bits < 16; ++bits) {
      Simplex part;
      for (unsigned j = 0; j < 4; ++j)
        if (bits >> j & 1) part.insert(v[j]);
      all.insert(part);
    }
  }
  return all;
}

Simplices linkOf(const Simplices& complex, const Simplex& centre) {
  Simplices link;
  for (const Simplex& s : complex) {
    if (!std::includes(s.begin(), s.end(), centre.begin(), centre.end())) continue;
    Simplex rest;
    std::set_difference(s.begin(), s.end(), centre.begin(), centre.end(),
                        std::inserter(rest, rest.begin()));
    if (!rest.empty()) link.insert(rest);
  }
  return link;
}

// Lk(u) n Lk(v) = Lk(uv) with the boundary coned, as it is written in the paper.
bool conditionHolds(const Simplices& complex, int64_t u, int64_t v) {
  const Simplices a = linkOf(complex, {u}), b = linkOf(complex, {v});
  Simplices common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(),
                        std::inserter(common, common.begin()));
  return common == linkOf(complex, {u, v});
}

struct Complex {
  explicit Complex(const TestMesh& the_mesh)
      : mesh(the_mesh),
        topology(account, mesh.cellCount() + 1, mesh.vertexCount() + 1),
        condition(account),
        stars(account) {
    const Simplices all = coned(mesh.cells);
    for (size_t v = 0; v < mesh.vertexCount(); ++v)
      topology.addVertex(all.count({kCone, static_cast<int64_t>(v)}) ? kFinal | kBoundary : kFinal);
    for (size_t c = 0; c < mesh.cellCount(); ++c) {
      uint32_t corners[4];
      for (size_t j = 0; j < 4; ++j) corners[j] = static_cast<uint32_t>(mesh.cells[4 * c + j]);
      topology.addCell(corners, cellSign(mesh, c) < 0 ? kNegative : 0);
    }
  }
  bool holds(int64_t u, int64_t v) {
    const auto a = static_cast<uint32_t>(u), b = static_cast<uint32_t>(v);
    topology.gather(a, b, stars.u, stars.ring);
    topology.gather(b, a, stars.v, stars.ring_from_v);
    return condition.holds({a, outside(u)}, {b, outside(v)}, stars);
  }
  bool outside(int64_t v) { return topology.vertexFlags(static_cast<uint32_t>(v)) & kBoundary; }

  TestMesh mesh;
  Account account;
  Topology topology;
  LinkCondition condition;
  Stars stars;
};

std::set<std::pair<int64_t, int64_t>> edgesOf(const TestMesh& mesh) {
  std::set<std::pair<int64_t, int64_t>> edges;
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    for (size_t i = 0; i < 4; ++i)
      for (size_t j = 0; j < 4; ++j)
        if (mesh.cells[4 * c + i] < mesh.cells[4 * c + j])
          edges.insert({mesh.cells[4 * c + i], mesh.cells[4 * c + j]});
  return edges;
}

int64_t vertexAt(const TestMesh& mesh, double x, double y, double z) {
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    if (mesh.position(v, 0) == x && mesh.position(v, 1) == y && mesh.position(v, 2) == z)
      return static_cast<int64_t>(v);
  ADD_FAILURE() << "no vertex there";
  return 0;
}

// ----------------------------------------------------------------------------- by hand

// The collapse of any edge of a single cell leaves nothing.
TEST(LinkCondition, ForbidsTheEndOfTheLastCell) {
  Complex k(oneCell());
  for (const auto& [u, v] : edgesOf(k.mesh)) EXPECT_FALSE(k.holds(u, v));
}

// Two cells on both sides of a face 123. The edges of that face belong to both: nothing would be
// left. An end 0 or 4 may go to the face: its cell dies, the other one stays.
TEST(LinkCondition, ForbidsTheEdgesThatAllCellsShare) {
  Complex k(makeMesh(ScalarType::kFloat64, {0, 0, -1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
                     {1, 2, 3, 0, 1, 3, 2, 4}));
  for (const auto& [u, v] : edgesOf(k.mesh)) EXPECT_EQ(k.holds(u, v), u == 0 || v == 4);
}

// Two cells 0123 and 0145 that share the edge 01 only. Nothing may happen to it, and 2 may not go
// to 3, though the edge 23 is one of a single cell: that cell would be gone, its edge 01 not.
TEST(LinkCondition, ForbidsWhatWouldLeaveTwoCellsAtAnEdge) {
  Complex k(makeMesh(ScalarType::kFloat64,
                     {0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, -1, 0, 0, -1, -1, 0},
                     {0, 1, 2, 3, 0, 1, 4, 5}));
  for (const auto& [u, v] : edgesOf(k.mesh)) EXPECT_FALSE(k.holds(u, v)) << u << " " << v;
}

// Three cells in a row round nothing: 0-1-2-3, 1-2-3-4, 2-3-4-5. The first vertex may go to the
// second one: only the cell 0123 dies, whose face 123 takes the place of the others.
TEST(LinkCondition, AllowsAnEndOfARow) {
  const TestMesh row =
      makeMesh(ScalarType::kFloat64, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3, 0.3, 1, 1, 1, 1, 0.5, 1, 2},
               {0, 1, 2, 3, 1, 2, 3, 4, 2, 3, 4, 5});
  Complex k(row);
  const Simplices all = coned(row.cells);
  int allowed = 0;
  for (const auto& [u, v] : edgesOf(row)) {
    EXPECT_EQ(k.holds(u, v), conditionHolds(all, u, v)) << u << " " << v;
    allowed += k.holds(u, v);
  }
  EXPECT_GT(allowed, 0);
}

// A plate one cube thick: an edge through the inside joins its two sides.
TEST(LinkCondition, ForbidsAnInnerEdgeBetweenTwoPlacesOfTheBoundary) {
  const TestMesh plate = fullGrid(4, 4, 1);
  Complex k(plate);
  EXPECT_FALSE(k.holds(vertexAt(plate, 2, 2, 0), vertexAt(plate, 2, 2, 1)));
  // On its rim the same edge is one of the boundary.
  EXPECT_TRUE(k.holds(vertexAt(plate, 4, 2, 0), vertexAt(plate, 4, 2, 1)));
}

TEST(LinkCondition, AllowsAnEdgeOfACube) {
  const TestMesh cube = fullGrid(3, 3, 3);
  Complex k(cube);
  EXPECT_TRUE(k.holds(vertexAt(cube, 1, 0, 0), vertexAt(cube, 2, 0, 0)));
  EXPECT_TRUE(k.holds(vertexAt(cube, 1, 1, 0), vertexAt(cube, 2, 1, 0)));
  EXPECT_TRUE(k.holds(vertexAt(cube, 1, 1, 1), vertexAt(cube, 2, 1, 1)));
  EXPECT_TRUE(k.holds(vertexAt(cube, 1, 1, 0), vertexAt(cube, 1, 1, 1)));
}

// One vertex inside a cell: it may go to any corner, and is the last inner one.
TEST(LinkCondition, AllowsTheLastInnerVertexToGoToTheBoundary) {
  Complex k(makeMesh(ScalarType::kFloat64, {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 4, 1, 1, 1},
                     {4, 1, 2, 3, 0, 4, 2, 3, 0, 1, 4, 3, 0, 1, 2, 4}));
  const Simplices all = coned(k.mesh.cells);
  for (int64_t corner = 0; corner < 4; ++corner) {
    EXPECT_TRUE(conditionHolds(all, corner, 4));
    EXPECT_TRUE(k.holds(corner, 4));
    EXPECT_TRUE(k.holds(4, corner));
  }
  // Two corners: the faces opposite would fall onto each other.
  EXPECT_FALSE(k.holds(0, 1));
}

// An edge uv with a ring of three a b c, and the face abc beside it closed by a cell on each side:
// uabc and vabc are faces' worth of a triangle in both links.
TEST(LinkCondition, ForbidsATriangleInBothLinks) {
  // u and v far apart, a b c round the middle of uv; u a b c and v a b c would be cells that
  // overlap the others in space, which a link condition must not rely on.
  const std::vector<int64_t> cells = {0, 1, 2, 3, 0, 1, 3, 4, 0, 1, 4, 2, 0, 2, 3, 4, 1, 2, 3, 4};
  Complex k(
      makeMesh(ScalarType::kFloat64, {0, 0, -2, 0, 0, 2, 1, 0, 0, -1, 1, 0, -1, -1, 0}, cells));
  const Simplices all = coned(cells);
  EXPECT_FALSE(conditionHolds(all, 0, 1));
  // All vertices are inside: the triangle is seen only if one end counts as outside.
  k.topology.flagVertex(0, kBoundary);
  EXPECT_FALSE(k.holds(0, 1));
}

// ----------------------------------------------------------------------------- at random

// Where more than two boundary faces meet at the edge the vertices are locked and the answer may be
// no; anywhere else it is that of the definition.
void expectDefinition(const TestMesh& mesh, int64_t* allowed, int64_t* forbidden) {
  Complex k(mesh);
  const Simplices all = coned(mesh.cells);
  for (const auto& [u, v] : edgesOf(mesh)) {
    if (!k.outside(u) && !k.outside(v)) continue;
    const bool wanted = conditionHolds(all, u, v);
    int64_t faces = 0;
    for (size_t w = 0; w < mesh.vertexCount(); ++w)
      faces += static_cast<int64_t>(static_cast<int64_t>(w) != u && static_cast<int64_t>(w) != v
                                        ? all.count({kCone, u, v, static_cast<int64_t>(w)})
                                        : 0);
    if (faces > 2 && !k.holds(u, v)) continue;
    EXPECT_EQ(k.holds(u, v), wanted) << u << " " << v;
    EXPECT_EQ(k.holds(v, u), wanted) << v << " " << u;
    ++*(wanted ? allowed : forbidden);
  }
}

TEST(LinkCondition, IsItsDefinitionOnRandomParts) {
  int64_t allowed = 0, forbidden = 0;
  for (uint64_t seed = 1; seed < (slowRun() ? 3u : 25u); ++seed) {
    Random r(seed);
    TestMesh mesh = fullGrid(2, 2, 2);
    // Cells taken out at random: non-manifold places, tunnels, dangling cells.
    std::vector<int64_t> cells;
    for (size_t c = 0; c < mesh.cellCount(); ++c)
      if (r.below(10) < 5 + seed % 5)
        cells.insert(cells.end(), &mesh.cells[4 * c], &mesh.cells[4 * c] + 4);
    mesh.cells = cells;
    expectDefinition(mesh, &allowed, &forbidden);
  }
  EXPECT_GT(allowed, 20);
  EXPECT_GT(forbidden, 20);
}

TEST(LinkCondition, IsItsDefinitionOnDomains) {
  if (slowRun()) return;
  int64_t allowed = 0, forbidden = 0;
  expectDefinition(slitGrid(4), &allowed, &forbidden);
  expectDefinition(shellGrid(3), &allowed, &forbidden);
  expectDefinition(ringGrid(3), &allowed, &forbidden);
  EXPECT_GT(allowed, 100);
  EXPECT_GT(forbidden, 100);
}

// -------------------------------------------------------- what a legal collapse does

// The mesh with v merged into u at the middle of both.
TestMesh merged(const TestMesh& mesh, int64_t u, int64_t v) {
  std::vector<double> positions;
  for (size_t w = 0; w < mesh.vertexCount(); ++w)
    for (int i = 0; i < 3; ++i)
      positions.push_back(static_cast<int64_t>(w) != u
                              ? mesh.position(w, i)
                              : 0.5 * (mesh.position(static_cast<size_t>(u), i) +
                                       mesh.position(static_cast<size_t>(v), i)));
  std::vector<int64_t> cells;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    std::vector<int64_t> cell(&mesh.cells[4 * c], &mesh.cells[4 * c] + 4);
    if (std::count(cell.begin(), cell.end(), u) && std::count(cell.begin(), cell.end(), v))
      continue;
    std::replace(cell.begin(), cell.end(), v, u);
    cells.insert(cells.end(), cell.begin(), cell.end());
  }
  return makeMesh(ScalarType::kFloat64, positions, cells);
}

// Random collapses that are allowed and turn no cell over, until none is left: the topology never
// changes. For edges inside, whose links are not looked at, this is the proof's other half.
TEST(LinkCondition, KeepsTheTopologyThroughAnyNumberOfCollapses) {
  int64_t inner = 0, outer = 0;
  for (int domain = 0; domain < 5; ++domain) {
    if (slowRun() && domain != 3) continue;
    Random r(static_cast<uint64_t>(domain));
    TestMesh mesh = domain == 0   ? fullGrid(3, 3, 3, 0.1)
                    : domain == 1 ? shellGrid(3)
                    : domain == 2 ? slitGrid(4)
                    : domain == 3 ? ringGrid(3)
                                  : fullGrid(4, 4, 4, 0.1);
    const MeshFacts before = factsOf(mesh);
    ASSERT_TRUE(before.manifold());
    for (int tries = 0, done = 0; tries < 300 && done < 60; ++tries) {
      Complex k(mesh);
      const auto edges = edgesOf(mesh);
      auto it = edges.begin();
      std::advance(it, r.below(static_cast<uint32_t>(edges.size())));
      const auto [u, v] = *it;
      if (!k.holds(u, v)) continue;
      const TestMesh next = merged(mesh, u, v);
      const MeshFacts after = factsOf(next);
      if (after.negative + after.flat > 0) continue;
      ASSERT_EQ(topologyChange(before, after), "") << "domain " << domain;
      ++(k.outside(u) || k.outside(v) ? outer : inner);
      mesh = next;
      ++done;
    }
  }
  EXPECT_GT(outer, 20);
  if (!slowRun()) {
    EXPECT_GT(inner, 5);
  }
}

// More vertices round an edge than a mask has bits: refused, whatever the answer would be.
TEST(LinkCondition, RefusesARingThatIsTooLarge) {
  for (int n : {40, 80}) {  // an edge on the boundary with n + 1 vertices round it, n cells
    std::vector<double> positions = {0, 0, 0, 0, 0, 1};
    std::vector<int64_t> cells;
    for (int k = 0; k <= n; ++k) {
      const double angle = 3.0 * k / n;
      positions.insert(positions.end(), {std::cos(angle), std::sin(angle), 0.5});
      if (k > 0) cells.insert(cells.end(), {0, 1, k + 1, k + 2});
    }
    // A layer of cells outside keeps the edge from being all there is.
    const auto apex = static_cast<int64_t>(positions.size() / 3);
    positions.insert(positions.end(), {0, 0, 3});
    for (int k = 1; k <= n; ++k) cells.insert(cells.end(), {1, k + 1, k + 2, apex});
    Complex k(makeMesh(ScalarType::kFloat64, positions, cells));
    EXPECT_TRUE(conditionHolds(coned(cells), 0, 1));
    EXPECT_EQ(k.holds(0, 1), n == 40);
  }
}

}  // namespace
}  // namespace tetstream::test
