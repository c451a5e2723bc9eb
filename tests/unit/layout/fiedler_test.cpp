// The lowest eigenvectors of graphs whose eigenvalues are known.
#include "fiedler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "test_mesh.h"

namespace tetstream::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct ListedGraph {
  explicit ListedGraph(const std::vector<std::set<uint32_t>>& of) : first{0} {
    for (const auto& list : of) {
      neighbour.insert(neighbour.end(), list.begin(), list.end());
      first.push_back(static_cast<uint32_t>(neighbour.size()));
    }
  }
  GraphView view() const {
    return {static_cast<uint32_t>(first.size() - 1), first.data(), neighbour.data(), nullptr};
  }
  std::vector<uint32_t> first, neighbour;
};

// a x b vertices, each with an edge to the next one along both axes.
ListedGraph grid(uint32_t a, uint32_t b) {
  std::vector<std::set<uint32_t>> of(a * b);
  for (uint32_t i = 0; i < a; ++i)
    for (uint32_t j = 0; j < b; ++j) {
      const uint32_t v = i * b + j;
      if (j + 1 < b) of[v].insert(v + 1), of[v + 1].insert(v);
      if (i + 1 < a) of[v].insert(v + b), of[v + b].insert(v);
    }
  return ListedGraph(of);
}

// Of a path of n vertices: 2 - 2 cos(pi k / n); of a grid: sums of two of those.
double ofPath(uint32_t n, uint32_t k) {
  return 2 - 2 * std::cos(kPi * k / n);
}

struct Solved {
  explicit Solved(const ListedGraph& graph) {
    values = lowestVectors(
        graph.view(), account, [] {}, x);
  }
  Account account;
  Array<Four> x{account};
  std::array<double, 4> values;
};

TEST(Fiedler, OfAPathIsACosine) {
  for (uint32_t n : {2u, 5u, 33u, 300u}) {
    const Solved solved(grid(1, n));
    for (uint32_t k = 0; k < 3 && k + 1 < n; ++k)
      EXPECT_NEAR(solved.values[k], ofPath(n, k + 1), 1e-3 * ofPath(n, k + 1)) << n << " " << k;
    const double scale = std::sqrt(2.0 / n) * (solved.x[0][0] < 0 ? -1 : 1);
    for (uint32_t i = 0; i < n; ++i)
      EXPECT_NEAR(static_cast<double>(solved.x[i][0]), scale * std::cos(kPi * (i + 0.5) / n), 2e-3);
  }
}

TEST(Fiedler, OfAGridHasItsLowestValues) {
  const uint32_t a = slowRun() ? 12 : 40, b = 2 * a + 3;
  const Solved solved(grid(a, b));
  EXPECT_NEAR(solved.values[0], ofPath(b, 1), 1e-3 * ofPath(b, 1));
  EXPECT_NEAR(solved.values[1], ofPath(b, 2), 1e-3 * ofPath(b, 2));
  EXPECT_NEAR(solved.values[2], ofPath(a, 1), 1e-3 * ofPath(a, 1));
}

TEST(Fiedler, VectorsAreOrthonormalAndWithoutAMean) {
  const uint32_t a = slowRun() ? 10 : 30;
  const Solved solved(grid(a, a));  // the lowest eigenvalue is double
  EXPECT_NEAR(solved.values[1], solved.values[0], 1e-3 * solved.values[0]);
  for (size_t k = 0; k < 4; ++k) {
    double mean = 0, dot[4] = {};
    for (size_t i = 0; i < solved.x.size(); ++i) {
      mean += static_cast<double>(solved.x[i][k]);
      for (size_t j = 0; j < 4; ++j)
        dot[j] += static_cast<double>(solved.x[i][k]) * static_cast<double>(solved.x[i][j]);
    }
    EXPECT_NEAR(mean, 0, 1e-3);
    for (size_t j = 0; j < 4; ++j) EXPECT_NEAR(dot[j], j == k ? 1 : 0, 1e-4);
  }
}

TEST(Fiedler, OfAStarIsFound) {
  std::vector<std::set<uint32_t>> of(400);
  for (uint32_t v = 1; v < 400; ++v) of[0].insert(v), of[v].insert(0);
  const Solved solved((ListedGraph(of)));  // 1, as often as there are leaves but one
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(solved.values[k], 1, 1e-2);
}

// x . A x of vector k.
double energy(const GraphView& graph, const std::vector<Four>& x, size_t k) {
  std::vector<Four> product(x.size());
  applyLaplacian(graph, x.data(), product.data());
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i)
    sum += static_cast<double>(x[i][k]) * static_cast<double>(product[i][k]);
  return sum;
}

TEST(Fiedler, ARoughSolutionIsSymmetricAndNearerThanNone) {
  const ListedGraph graph = grid(20, 30);
  Account account;
  LaplacianLevels levels(graph.view(), account);
  const size_t n = 600;
  std::vector<Four> wanted(n), b(n), x(n);
  for (size_t i = 0; i < n; ++i)  // smooth, rough, in between, nothing
    wanted[i] = Four{static_cast<float>(i) / n, static_cast<float>(i * i % 7),
                     static_cast<float>(i % 30 / 5), 0};
  applyLaplacian(graph.view(), wanted.data(), b.data());
  levels.solveRoughly(0, b.data(), x.data());
  double ab = 0, ba = 0;
  std::vector<Four> rest(n);
  for (size_t i = 0; i < n; ++i) {
    ab += static_cast<double>(b[i][0] * x[i][1]);
    ba += static_cast<double>(b[i][1] * x[i][0]);
    rest[i] = wanted[i] - x[i];
    EXPECT_EQ(x[i][3], 0);
  }
  EXPECT_NEAR(ab, ba, 1e-4 * std::abs(ab));
  for (size_t k = 0; k < 3; ++k)
    EXPECT_LT(energy(graph.view(), rest, k), 0.5 * energy(graph.view(), wanted, k)) << k;
}

}  // namespace
}  // namespace tetstream::test
