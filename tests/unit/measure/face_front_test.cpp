// The topology of meshes small enough to be counted by hand, as a stream and all at the end.
#include "mesh_scan.h"

#include <gtest/gtest.h>

#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

struct Scanned {
  TopologyFigures topology;
  ShapeFigures shapes;
  size_t peak;
};

Scanned scan(const TestMesh& mesh, const Cut& cut = {}) {
  Account account;
  const RowBudget rows = {account, "", size_t{1} << 16};
  ScanPlan plan;
  plan.mesh = "it";
  MeshStream stream(mesh, cut);
  MeshScan scan(stream.schema(), plan, {rows, rows}, account);
  scan.read(stream, [](double) {});
  return {scan.topology(), scan.shapes(), account.peak()};
}

TEST(FaceFront, CountsOneCell) {
  const Scanned s = scan(oneCell());
  EXPECT_EQ(s.topology.vertices, 4);
  EXPECT_EQ(s.topology.edges, 6);
  EXPECT_EQ(s.topology.faces, 4);
  EXPECT_EQ(s.topology.euler(), 1);
  EXPECT_EQ(s.topology.boundaryEuler(), 2);
  EXPECT_NEAR(s.shapes.volume, 1.0 / 6, 1e-16);
}

struct Known {
  TestMesh mesh;
  int64_t euler, boundary_euler, components, boundary_components, edges, vertices;
};

TEST(FaceFront, KnowsHolesVoidsAndPinches) {
  const Known known[] = {
      {fullGrid(3, 3, 3), 1, 2, 1, 1, 0, 0},
      {shellGrid(4), 2, 4, 1, 2, 0, 0},  // a void
      {ringGrid(4), 0, 0, 1, 1, 0, 0},   // a hole
      {apart(2), 2, 4, 2, 2, 0, 0},
      {cubesAtVertex(2), 1, 3, 1, 1, 0, 1},            // pinched: two fans at the vertex
      {cubesAtEdge(2), 1, 2 + 2 - 5 + 2, 1, 1, 2, 1},  // three vertices and two edges in common
  };
  for (const Known& k : known)
    for (int explicit_final = 0; explicit_final < 2; ++explicit_final) {
      Cut cut;
      cut.explicit_final = explicit_final != 0;
      cut.batch_cells = 17;
      const TopologyFigures t = scan(inStreamOrder(k.mesh), cut).topology;
      EXPECT_EQ(t.euler(), k.euler);
      EXPECT_EQ(t.components, k.components);
      EXPECT_EQ(t.boundary_components, k.boundary_components);
      EXPECT_EQ(t.nonmanifold_edges, k.edges);
      EXPECT_EQ(t.nonmanifold_faces, 0);
      EXPECT_EQ(t.folded_faces, 0);
      if (k.edges == 0) {
        EXPECT_EQ(t.boundaryEuler(), k.boundary_euler);
        EXPECT_EQ(t.nonmanifold_vertices, k.vertices);
      }
    }
}

// Three cells at one face; two on the same side of one.
TEST(FaceFront, KnowsWhatIsNoMesh) {
  const std::vector<double> points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0.1, 0.1, 2};
  const TestMesh three =
      makeMesh(ScalarType::kFloat64, points, {0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5});
  EXPECT_EQ(scan(inStreamOrder(three)).topology.nonmanifold_faces, 1);
  const TestMesh folded = makeMesh(ScalarType::kFloat64, points, {0, 1, 2, 3, 0, 1, 2, 5});
  EXPECT_EQ(scan(inStreamOrder(folded, true)).topology.folded_faces, 1);
  const TestMesh fine = makeMesh(ScalarType::kFloat64, points, {0, 1, 2, 3, 1, 0, 2, 4});
  EXPECT_EQ(scan(inStreamOrder(fine, true)).topology.folded_faces, 0);
  EXPECT_EQ(scan(inStreamOrder(fine, true)).topology.vertices, 5);  // the unused one counts not
}

// Cells that come twice, in whatever order of their corners, and once more, wherever they come.
TEST(FaceFront, CountsDuplicateCells) {
  TestMesh mesh = fullGrid(3, 3, 3);
  EXPECT_EQ(scan(mesh).topology.duplicate_cells, 0);
  const size_t count = mesh.cellCount();
  for (size_t c : {size_t{0}, count / 2, count - 1}) {
    const int64_t* v = mesh.cells.data() + 4 * c;
    mesh.cells.insert(mesh.cells.end(), {v[2], v[0], v[3], v[1]});
  }
  EXPECT_EQ(scan(inStreamOrder(mesh)).topology.duplicate_cells, 3);
  EXPECT_EQ(scan(inStreamOrder(shuffled(mesh, 5))).topology.duplicate_cells, 3);
  const int64_t* v = mesh.cells.data();
  mesh.cells.insert(mesh.cells.end(), {v[0], v[1], v[2], v[3]});
  EXPECT_EQ(scan(inStreamOrder(mesh)).topology.duplicate_cells, 4);
}

TEST(FaceFront, TakesTheMemoryOfTheFront) {
  const size_t small = scan(fullGrid(4, 4, 50)).peak, large = scan(fullGrid(4, 4, 500)).peak;
  EXPECT_LT(large, small + (small >> 2));
}

TEST(MeshScan, RefusesWhatIsNotFinite) {
  TestMesh mesh = oneCell();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(mesh.positions.bytes.data(), &nan, sizeof nan);
  EXPECT_THROW(scan(mesh), Error);
}

}  // namespace
}  // namespace tetstream::test
