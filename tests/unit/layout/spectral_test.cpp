// The spectral order: narrow fronts, whatever the shape and whatever the order before.
#include "spectral.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "order_checks.h"
#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

struct SpectralOrder {
  explicit SpectralOrder(const TestMesh& test_mesh) : mesh(test_mesh) {
    orderSpectral(
        mesh.connectivity, account, [this] { ++told; }, rank);
  }
  int64_t width() { return frontOfRanks(mesh.connectivity, rank, account).front_width; }
  int64_t sweepWidth(int axis) {
    Array<uint32_t> along(account, mesh.connectivity.vertices);
    rankAlong(mesh, axis, along);
    return frontOfRanks(mesh.connectivity, along, account).front_width;
  }
  int64_t bestSweepWidth() { return std::min({sweepWidth(0), sweepWidth(1), sweepWidth(2)}); }
  OrderMesh mesh;
  Account account;
  Array<uint32_t> rank{account};
  int told = 0;
};

TEST(Spectral, SweepsABarAlongItsLongAxis) {
  const int n = slowRun() ? 3 : 6;
  const TestMesh bar = shuffled(fullGrid(n, n, 8 * n, 0.1), 1);
  SpectralOrder ordered(bar);
  EXPECT_LE(ordered.width(), ordered.sweepWidth(2));
  EXPECT_LE(ordered.width(), (n + 1) * (n + 1) + n + 3);  // a cross-section and little more
  // Ranks rise or fall along the axis: fronts are skew by fewer than as many cubes as they have
  // across.
  std::vector<uint32_t> low(static_cast<size_t>(8 * n) + 1, kUnused), high(low.size(), 0);
  for (uint32_t v = 0; v < bar.vertexCount(); ++v) {
    const auto z = static_cast<size_t>(bar.position(v, 2) + 0.5);
    low[z] = std::min(low[z], ordered.rank[v]);
    high[z] = std::max(high[z], ordered.rank[v]);
  }
  const auto skew = static_cast<size_t>(n);
  const bool rises = low[0] < low[low.size() - 1];
  for (size_t z = 0; z + skew < low.size(); ++z)
    EXPECT_TRUE(rises ? high[z] < low[z + skew] : low[z] > high[z + skew]) << z;
  EXPECT_GT(ordered.told, 10);
}

TEST(Spectral, IsNoWiderThanASweepOfCompactDomains) {
  const int n = slowRun() ? 4 : 8;
  for (const TestMesh& mesh : {fullGrid(n, n, n), shellGrid(n), fullGrid(n, 2 * n, 2 * n),
                               shuffled(fullGrid(n, n + 1, n + 2, 0.1), 7)}) {
    SpectralOrder ordered(mesh);
    EXPECT_LE(ordered.width(), ordered.bestSweepWidth());
  }
}

// A tube that turns back twice: a sweep meets three arms at once, or one of them lengthwise.
TEST(Spectral, FollowsATubeThatTurns) {
  const int arm = slowRun() ? 12 : 30;
  SpectralOrder ordered(cubes(11, 3, arm, [arm](int x, int, int z) {
    return x % 4 != 3 || (x == 3 ? z >= arm - 3 : z < 3);
  }));
  EXPECT_LE(2 * ordered.width(), ordered.bestSweepWidth());
}

TEST(Spectral, DoesNotDependOnTheOrderBefore) {
  const int n = slowRun() ? 3 : 5;
  const TestMesh bar = fullGrid(n, n, 5 * n, 0.1);
  const int64_t width = SpectralOrder(bar).width();
  for (uint64_t seed : {1, 2}) {
    const int64_t other = SpectralOrder(shuffled(bar, seed)).width();
    EXPECT_LE(10 * std::abs(other - width), width);
  }
}

TEST(Spectral, RanksEachVertexOnceComponentAfterComponent) {
  for (const TestMesh& mesh : oddMeshes()) {
    const SpectralOrder ordered(mesh);
    EXPECT_EQ(ordered.rank.size(), mesh.vertexCount());
    EXPECT_TRUE(isPermutation(ordered.rank));
    EXPECT_TRUE(componentsAreConsecutive(ordered.mesh.connectivity, ordered.rank));
  }
}

// All cells meet at two vertices: the graph has two vertices that all others neighbour.
TEST(Spectral, OrdersAFan) {
  std::vector<int64_t> cells;
  const int64_t rim = 500;
  for (int64_t i = 0; i < rim; ++i) {
    const int64_t cell[4] = {0, 1, 2 + i, 2 + (i + 1) % rim};
    cells.insert(cells.end(), cell, cell + 4);
  }
  SpectralOrder ordered(makeMesh(ScalarType::kFloat64, std::vector<double>(3 * 502, 0.0), cells));
  EXPECT_TRUE(isPermutation(ordered.rank));
  // Two vertices in the middle and the two ends of the part that was read.
  EXPECT_LE(ordered.width(), 6);
}

TEST(Spectral, IsTheSameTwice) {
  const TestMesh mesh = shuffled(shellGrid(6), 3);
  const SpectralOrder a(mesh), b(mesh);
  EXPECT_TRUE(std::equal(a.rank.data(), a.rank.data() + a.rank.size(), b.rank.data()));
}

TEST(Spectral, StopsWhenItIsToldTo) {
  OrderMesh mesh(fullGrid(3, 3, 9));
  for (int at : {0, 1, 2, 5, 20}) {
    Account account;
    {
      Array<uint32_t> rank(account);
      int calls = 0;
      EXPECT_THROW(orderSpectral(
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

TEST(Spectral, FailsCleanlyWithoutMemory) {
  OrderMesh mesh(fullGrid(3, 3, 9));
  Account needed;
  {
    Array<uint32_t> rank(needed);
    orderSpectral(
        mesh.connectivity, needed, [] {}, rank);
  }
  for (size_t part = 1; part < 8; ++part) {
    Account account(needed.peak() * part / 8);
    {
      Array<uint32_t> rank(account);
      EXPECT_THROW(orderSpectral(
                       mesh.connectivity, account, [] {}, rank),
                   Error);
    }
    EXPECT_EQ(account.used(), 0u);
  }
}

// Smooth values: along a bar they rise or fall with it; from i to i + 1 in the i-th component.
TEST(Spectral, FindsValuesThatVarySmoothly) {
  const int n = slowRun() ? 3 : 5;
  const TestMesh bar = shuffled(fullGrid(n, n, 8 * n, 0.1), 1);
  const OrderMesh mesh(bar);
  Account account;
  Array<float> value(account);
  findSpectralValues(
      mesh.connectivity, account, [] {}, value);
  const auto [low, high] = std::minmax_element(value.data(), value.data() + bar.vertexCount());
  EXPECT_EQ(*low, 0);
  EXPECT_EQ(*high, 1);
  const auto z = [&](const float* at) {
    return bar.position(static_cast<size_t>(at - value.data()), 2);
  };
  EXPECT_GT(std::abs(z(low) - z(high)), 8 * n - 1.5);
  const OrderMesh two(apart(3));
  findSpectralValues(
      two.connectivity, account, [] {}, value);
  size_t second = 0;
  for (uint32_t v = 0; v < two.connectivity.vertices; ++v) {
    EXPECT_GE(value[v], 0);
    EXPECT_LE(value[v], 2);
    second += value[v] > 1;
  }
  EXPECT_GT(second, two.connectivity.vertices / 3);
  EXPECT_LE(second, two.connectivity.vertices / 2 + 1);
}

}  // namespace
}  // namespace tetstream::test
