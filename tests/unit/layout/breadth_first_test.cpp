// The paper's breadth-first order, by its rules and by its front.
#include "breadth_first.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "order_checks.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

struct BreadthFirstOrder {
  explicit BreadthFirstOrder(const TestMesh& test_mesh) : mesh(test_mesh) {
    orderBreadthFirst(
        mesh.connectivity, account, [this] { ++told; }, rank);
  }
  OrderMesh mesh;
  Account account;
  Array<uint32_t> rank{account};
  int told = 0;
  OrderFront front() { return frontOfRanks(mesh.connectivity, rank, account); }
};

// Whether some cell has all its vertices among those ranked below `end`, but for v.
bool completes(const Connectivity& mesh, const Array<uint32_t>& rank, uint32_t v, uint32_t end) {
  for (uint32_t c = 0; c < mesh.cells; ++c) {
    const uint32_t* corners = mesh.cell(c);
    if (std::count(corners, corners + 4, v) == 1 &&
        std::count_if(corners, corners + 4, [&](uint32_t u) { return rank[u] < end; }) == 3)
      return true;
  }
  return false;
}

TEST(BreadthFirst, TheNextVertexIsANeighbourOfTheOldestAndCompletesACellIfOneDoes) {
  const BreadthFirstOrder ordered(shuffled(fullGrid(2, 3, 4), 4));
  const Connectivity& mesh = ordered.mesh.connectivity;
  const auto neighbours = neighboursOf(mesh);
  std::vector<uint32_t> at(mesh.vertices);
  for (uint32_t v = 0; v < mesh.vertices; ++v) at[ordered.rank[v]] = v;
  uint32_t oldest = 0;
  for (uint32_t i = 1; i < mesh.vertices; ++i) {
    std::vector<uint32_t> choice;
    for (;; ++oldest) {
      ASSERT_LT(oldest, i);
      for (uint32_t u : neighbours[at[oldest]])
        if (ordered.rank[u] >= i) choice.push_back(u);
      if (!choice.empty()) break;
    }
    EXPECT_TRUE(std::count(choice.begin(), choice.end(), at[i]));
    const bool possible = std::any_of(choice.begin(), choice.end(), [&](uint32_t u) {
      return completes(mesh, ordered.rank, u, i);
    });
    EXPECT_EQ(completes(mesh, ordered.rank, at[i], i), possible);
  }
}

TEST(BreadthFirst, TheSpanIsAtMostOneAndAHalfTimesTheWidthOfABar) {
  const int n = slowRun() ? 3 : 6;
  BreadthFirstOrder ordered(shuffled(fullGrid(n, n, 8 * n), 1));
  const OrderFront front = ordered.front();
  EXPECT_LE(2 * front.front_span, 3 * front.front_width);
  // Fronts run along the bar: a cross-section has (n + 1)^2 vertices, a skew one two or three
  // times as many, a plane along the bar 8 times.
  EXPECT_LE(front.front_width, 3 * (n + 1) * (n + 1));
  EXPECT_GT(ordered.told, 3);
}

TEST(BreadthFirst, BeginsOnTheBoundaryAtAnEnd) {
  const TestMesh bar = fullGrid(3, 3, 24);
  const BreadthFirstOrder ordered(bar);
  for (uint32_t v = 0; v < bar.vertexCount(); ++v) {
    if (ordered.rank[v] != 0) continue;
    const double z = bar.position(v, 2);
    EXPECT_TRUE(z == 0 || z == 24) << z;
  }
}

TEST(BreadthFirst, RanksEachVertexOnceComponentAfterComponent) {
  for (const TestMesh& mesh : oddMeshes()) {
    const BreadthFirstOrder ordered(mesh);
    EXPECT_EQ(ordered.rank.size(), mesh.vertexCount());
    EXPECT_TRUE(isPermutation(ordered.rank));
    EXPECT_TRUE(componentsAreConsecutive(ordered.mesh.connectivity, ordered.rank));
  }
}

TEST(BreadthFirst, IsTheSameTwice) {
  const TestMesh mesh = shuffled(shellGrid(5), 3);
  const BreadthFirstOrder a(mesh), b(mesh);
  EXPECT_TRUE(std::equal(a.rank.data(), a.rank.data() + a.rank.size(), b.rank.data()));
}

TEST(BreadthFirst, StopsWhenItIsToldTo) {
  OrderMesh mesh(fullGrid(3, 3, 3));
  for (int at = 0; at < 6; ++at) {
    Account account;
    {
      Array<uint32_t> rank(account);
      int calls = 0;
      EXPECT_THROW(orderBreadthFirst(
                       mesh.connectivity, account,
                       [&] {
                         if (calls++ == at) throw 1;
                       },
                       rank),
                   int);
    }
    EXPECT_EQ(account.used(), 0u);
  }
}

}  // namespace
}  // namespace tetstream::test
