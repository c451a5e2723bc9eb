// Which vertices and cells of a mesh meet.
#include "vertex_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "order_checks.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

struct Built {
  explicit Built(const TestMesh& test_mesh) : mesh(test_mesh) {
    listCells(mesh.connectivity, lists);
    buildGraph(mesh.connectivity, lists, account, graph);
    markBoundary(mesh.connectivity, lists, boundary);
    components = findComponents(graph, account, member, start);
  }
  OrderMesh mesh;
  Account account;
  CellLists lists{account};
  VertexGraph graph{account};
  Array<uint8_t> boundary{account};
  Array<uint32_t> member{account}, start{account};
  uint32_t components = 0;
};

TEST(VertexGraph, HasEachNeighbourOnce) {
  std::vector<TestMesh> meshes = oddMeshes();
  meshes.push_back(shuffled(fullGrid(3, 4, 5), 1));
  for (const TestMesh& mesh : meshes) {
    const Built built(mesh);
    const auto neighbours = neighboursOf(built.mesh.connectivity);
    ASSERT_EQ(built.graph.vertices, mesh.vertexCount());
    for (uint32_t v = 0; v < built.graph.vertices; ++v) {
      EXPECT_EQ(built.graph.degree(v), neighbours[v].size());
      EXPECT_EQ(std::set<uint32_t>(built.graph.begin(v), built.graph.end(v)), neighbours[v]);
    }
  }
}

TEST(VertexGraph, ListsTheCellsOfAVertex) {
  const Built built(shuffled(fullGrid(2, 3, 4), 2));
  const Connectivity& mesh = built.mesh.connectivity;
  for (uint32_t v = 0; v < mesh.vertices; ++v) {
    std::vector<uint32_t> cells;
    for (uint32_t c = 0; c < mesh.cells; ++c)
      if (std::count(mesh.cell(c), mesh.cell(c) + 4, v)) cells.push_back(c);
    EXPECT_EQ(std::vector<uint32_t>(built.lists.cell.data() + built.lists.first[v],
                                    built.lists.cell.data() + built.lists.first[v + 1]),
              cells);
  }
}

TEST(VertexGraph, ACellThatNamesAVertexTwiceIsListedOnceThere) {
  const Built built(makeMesh(ScalarType::kFloat64, std::vector<double>(9, 0.0), {0, 1, 1, 2}));
  EXPECT_EQ(built.lists.cell.size(), 3u);
  EXPECT_EQ(built.graph.degree(1), 2u);
}

TEST(VertexGraph, ComponentsShareNoVertexAndUnusedVerticesAreTheirOwn) {
  EXPECT_EQ(Built(fullGrid(2, 2, 2)).components, 1u);
  EXPECT_EQ(Built(cubesAtVertex(2)).components, 1u);
  EXPECT_EQ(Built(apart(2)).components, 2u);
  EXPECT_EQ(
      Built(makeMesh(ScalarType::kFloat64, std::vector<double>(27, 0.0), {4, 2, 7, 5})).components,
      6u);
  EXPECT_EQ(Built(makeMesh(ScalarType::kFloat64, {}, {})).components, 0u);
}

TEST(VertexGraph, MembersAreOfTheirComponentsBreadthFirst) {
  const Built built(shuffled(apart(2), 5));
  const auto neighbours = neighboursOf(built.mesh.connectivity);
  ASSERT_EQ(built.start[built.components], built.graph.vertices);
  for (uint32_t c = 0; c < built.components; ++c) {
    std::set<uint32_t> before{built.member[built.start[c]]};
    for (uint32_t i = built.start[c] + 1; i < built.start[c + 1]; ++i) {
      const auto& near = neighbours[built.member[i]];
      EXPECT_TRUE(
          std::any_of(near.begin(), near.end(), [&](uint32_t u) { return before.count(u) > 0; }));
      EXPECT_TRUE(before.insert(built.member[i]).second);
      EXPECT_GT(built.member[i], built.member[built.start[c]]);  // the first has the lowest number
    }
  }
}

TEST(VertexGraph, TheBoundaryIsWhereOneCellHasAFace) {
  const TestMesh grid = fullGrid(3, 3, 3);
  const Built built(grid);
  for (uint32_t v = 0; v < built.graph.vertices; ++v) {
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis)
      inside = inside && grid.position(v, axis) > 0 && grid.position(v, axis) < 3;
    EXPECT_EQ(built.boundary[v], !inside);
  }
  // A crack: of the 3^3 vertices inside a cube of 4^3 the middle one is doubled, and it and the six
  // round it in its plane are on faces of one cell.
  const Built slit(slitGrid(4));
  EXPECT_EQ(slit.graph.vertices, 126u);
  EXPECT_EQ(std::count(slit.boundary.data(), slit.boundary.data() + 126, 0), 20);
  // No face is of one cell only where each cell is there twice; unused vertices are on none.
  const Built twice(
      makeMesh(ScalarType::kFloat64, std::vector<double>(15, 0.0), {0, 1, 2, 3, 3, 1, 0, 2}));
  EXPECT_EQ(std::count(twice.boundary.data(), twice.boundary.data() + 5, 0), 5);
}

}  // namespace
}  // namespace tetstream::test
