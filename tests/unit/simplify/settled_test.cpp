// What a sweep leaves behind for the next: no edge worth looking at is forgotten.
#include "settled.h"

#include <cmath>
#include <set>

#include "tiling.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

template <class S>
Edges freeEdges(const Window<S>& window) {
  Edges edges;
  for (uint32_t c = 0; c < window.cellEnd(); ++c)
    for (uint32_t i = 0; i < 4 && window.isLive(c); ++i)
      for (uint32_t j = 0; j < 4; ++j) {
        const uint32_t u = window.vertexOf(c, i), v = window.vertexOf(c, j);
        if (u < v && window.isFree(u) && window.isFree(v)) edges.insert({u, v});
      }
  return edges;
}

template <class S>
double errorOfEdge(Core<S>& core, uint32_t u, uint32_t v) {
  std::vector<S> z(static_cast<size_t>(core.plan.dimension));
  return static_cast<double>(core.kernels.solveEdge(
      core.window.quadric(u), core.window.values(u), core.window.quadric(v), core.window.values(v),
      core.scale.data(), core.plan.dimension, z.data()));
}

TestMesh gridOfManyTiles() {
  const int n = slowRun() ? 12 : 30;  // 30: more than six tiles
  TestMesh mesh = fullGrid(n, n, n, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return std::sin(0.3 * x) * y + 0.1 * z * z;
  });
  return mesh;
}

// Sweeps at a bound above this share of all edges; it is not exceeded, since nothing is asked for.
struct Swept : WholeWindow<double> {
  explicit Swept(double share)
      : WholeWindow<double>(gridOfManyTiles(), {}), selector(makeSweepSelector(core, account)) {
    std::vector<double> errors;
    for (auto [u, v] : freeEdges(core.window)) errors.push_back(errorOfEdge(core, u, v));
    const auto below = static_cast<size_t>(share * static_cast<double>(errors.size()));
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(below),
                     errors.end());
    bound = errors[below];
  }
  void sweep() {
    Goal goal{core.window.liveCells(), 0, false};
    goal.first_bound = bound;
    selector->decimate(goal, [] {});
  }
  std::unique_ptr<Selector> selector;
  double bound;
};

TEST(Settled, NoEdgeBelowTheBoundIsForgotten) {
  Swept s(0.25);
  const int64_t before = s.core.window.liveCells();
  for (int round = 0; round < 3; ++round) {  // the second and third begin with what was left
    s.sweep();
    for (auto [u, v] : freeEdges(s.core.window)) {
      const Settled a = settledOf(s.core.window, u), b = settledOf(s.core.window, v);
      const double known = std::min(a.least, b.least), error = errorOfEdge(s.core, u, v);
      ASSERT_TRUE(known <= error * (1 + 1e-6) || a.refused || b.refused)
          << u << " " << v << ": " << error << ", known: " << known;
    }
    s.bound *= 2;
  }
  EXPECT_LT(s.core.window.liveCells(), before * 9 / 10);
}

// Each collapse leaves some twenty vertices whose cells have changed.
TEST(Settled, WhatIsAboveTheBoundIsNotListedAgain) {
  Swept s(0.01);
  s.sweep();
  Tiling<double> tiling(s.core, s.account);
  const auto listed = [&](float bound) {
    tiling.build(0, bound);
    size_t count = 0;
    for (const TilePiece& t : tiling.tiles()) count += t.vertex_end - t.vertex_begin;
    return count;
  };
  const size_t all = listed(std::numeric_limits<float>::infinity());
  EXPECT_FALSE(tiling.othersWait());
  EXPECT_LT(listed(static_cast<float>(s.bound)), all * 9 / 10);
  EXPECT_TRUE(tiling.othersWait());
  EXPECT_LT(tiling.looking(), static_cast<int64_t>(all / 4));
}

TEST(Settled, IsKeptWithTheVertex) {
  WholeWindow<float> w(fullGrid(2, 2, 2));
  settle(w.core.window, 3, {2.5f, true, false});
  EXPECT_EQ(settledOf(w.core.window, 3).least, 2.5f);
  EXPECT_TRUE(settledOf(w.core.window, 3).refused);
  EXPECT_FALSE(settledOf(w.core.window, 3).spared);
  settle(w.core.window, 3, {0.5f, false, true});
  EXPECT_FALSE(settledOf(w.core.window, 3).refused);
  EXPECT_TRUE(settledOf(w.core.window, 3).spared);
  unsettle(w.core.window, 3);
  EXPECT_EQ(settledOf(w.core.window, 3).least, 0.0f);
}

}  // namespace
}  // namespace tetstream::test
