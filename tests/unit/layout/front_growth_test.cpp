// Sequences in which few vertices are active.
#include "front_growth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "order_checks.h"
#include "random.h"
#include "shapes.h"
#include "vertex_graph.h"

namespace tetstream::test {
namespace {

struct MeshGraph {
  explicit MeshGraph(const TestMesh& test_mesh) : mesh(test_mesh) {
    CellLists lists(account);
    listCells(mesh.connectivity, lists);
    buildGraph(mesh.connectivity, lists, account, graph);
    view = {graph.vertices, graph.first.data(), graph.neighbour.data(), nullptr};
  }
  OrderFront front(const std::vector<uint32_t>& sequence) {
    Array<uint32_t> rank(account, view.vertices);
    for (uint32_t i = 0; i < view.vertices; ++i) rank[sequence[i]] = view.vertices - 1 - i;
    return frontOfRanks(mesh.connectivity, rank, account);
  }
  OrderMesh mesh;
  Account account;
  VertexGraph graph{account};
  GraphView view;
};

std::vector<float> guideAlong(const TestMesh& mesh, int axis, float factor) {
  std::vector<float> guide;
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    guide.push_back(factor * static_cast<float>(mesh.position(v, axis)));
  return guide;
}

TEST(FrontGrowth, OfAGridIsAPlaneWide) {
  const TestMesh mesh = shuffled(fullGrid(3, 4, 9), 1);
  MeshGraph graph(mesh);
  std::vector<uint32_t> sequence(mesh.vertexCount());
  FrontGrowth growth(graph.view, graph.account);
  const auto guide = guideAlong(mesh, 2, 1);
  const uint32_t width = growth.run(guide.data(), sequence.data());
  EXPECT_LE(width, 4u * 5u + 6u);
  EXPECT_GE(width, 4u * 5u);
  auto sorted = sequence;
  std::sort(sorted.begin(), sorted.end());
  for (uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
  EXPECT_LE(mesh.position(sequence[0], 2), 1);
  EXPECT_GE(mesh.position(sequence.back(), 2), 8);
}

// Read backwards it is a stream, in which cells come as late as possible one by one.
TEST(FrontGrowth, ItsWidthBoundsThatOfTheStream) {
  for (const TestMesh& mesh : {fullGrid(3, 4, 5), shellGrid(4), slitGrid(4)}) {
    MeshGraph graph(mesh);
    std::vector<uint32_t> sequence(mesh.vertexCount());
    FrontGrowth growth(graph.view, graph.account);
    for (int axis = 0; axis < 3; ++axis) {
      const auto guide = guideAlong(mesh, axis, 2);
      const int64_t width = growth.run(guide.data(), sequence.data());
      const int64_t of_stream = graph.front(sequence).front_width;
      EXPECT_LE(of_stream, width);
      EXPECT_GE(of_stream + 3, width);  // up to three vertices come with the same cell
      std::vector<float> layers(mesh.vertexCount());
      EXPECT_EQ(findLayers(graph.view, sequence.data(), graph.account, layers.data()), width);
    }
  }
}

TEST(FrontGrowth, WithAStrongGuideIsTheGuide) {
  const TestMesh mesh = fullGrid(2, 2, 6);
  MeshGraph graph(mesh);
  std::vector<uint32_t> sequence(mesh.vertexCount());
  FrontGrowth growth(graph.view, graph.account);
  const auto guide = guideAlong(mesh, 2, 1000);
  growth.run(guide.data(), sequence.data());
  // But for vertices by whose closing nothing comes.
  for (size_t i = 1; i < sequence.size(); ++i)
    EXPECT_LE(mesh.position(sequence[i - 1], 2), mesh.position(sequence[i], 2) + 1);
}

TEST(FrontGrowth, LayersRiseAlongTheSequenceByOneAtEachFront) {
  const TestMesh mesh = fullGrid(3, 3, 40);
  MeshGraph graph(mesh);
  std::vector<uint32_t> sequence(mesh.vertexCount());
  for (uint32_t i = 0; i < sequence.size(); ++i) sequence[i] = i;
  std::stable_sort(sequence.begin(), sequence.end(), [&](uint32_t a, uint32_t b) {
    return mesh.position(a, 2) < mesh.position(b, 2);
  });
  std::vector<float> layers(sequence.size());
  const uint32_t width = findLayers(graph.view, sequence.data(), graph.account, layers.data());
  EXPECT_GE(width, 16u);
  for (size_t i = 1; i < sequence.size(); ++i)
    EXPECT_GT(layers[sequence[i]], layers[sequence[i - 1]]);
  // 41 cross-sections of 16 vertices, of which 16 to 24 are active.
  EXPECT_GT(layers[sequence.back()], 41.0f * 16 / 24);
  EXPECT_LT(layers[sequence.back()], 41.0f + 3);
}

}  // namespace
}  // namespace tetstream::test
