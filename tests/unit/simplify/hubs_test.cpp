// Vertices with very many cells, which are left alone until they have fewer.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "folds.h"
#include "patch_sweep.h"
#include "simplify_testing.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

using Sweep = PatchSweep<double>;

// Wedges round an axis, each of three cells. Vertices 0 and 1 are the ends of the axis: all cells
// have the first one, a third of them the other.
TestMesh wheel(int64_t wedges) {
  std::vector<double> positions = {0, 0, 0, 0, 0, 1};
  for (const double z : {0.0, 1.0})
    for (int64_t i = 0; i < wedges; ++i) {
      const double turn =
          2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(wedges);
      positions.insert(positions.end(), {std::cos(turn), std::sin(turn), z});
    }
  std::vector<int64_t> cells;
  for (int64_t i = 0; i < wedges; ++i) {
    const auto [low, high] = std::minmax({2 + i, 2 + (i + 1) % wedges});
    cells.insert(cells.end(), {0, low, high, high + wedges, 0, low, low + wedges, high + wedges, 0,
                               1, low + wedges, high + wedges});
  }
  TestMesh mesh = makeMesh(ScalarType::kFloat64, positions, cells);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(2 * x) * y + z; });
  return mesh;
}

// The vertices that a sweep of all of them owns, by their slots.
std::vector<uint32_t> ownedOf(int64_t wedges) {
  WholePatch<double> w(wheel(wedges));
  Sweep sweep(w.core, w.account);
  std::vector<uint32_t> cells(w.core.window.mesh.cellEnd()), owned;
  std::iota(cells.begin(), cells.end(), 0u);
  EXPECT_TRUE(sweep.load(w.owned.data(), w.owned.size(), cells.data(), cells.size()));
  EXPECT_EQ(sweep.patch().cellEnd(), cells.size());
  EXPECT_EQ(sweep.patch().vertexEnd(), w.owned.size());
  for (uint32_t v = 0; v < sweep.patch().ownedEnd(); ++v) owned.push_back(sweep.patch().slotOf(v));
  return owned;
}

TEST(Hubs, AreNotOwnedByASweep) {
  constexpr int64_t kMost = Sweep::kLargestStar / 3;
  for (const int64_t wedges : {kMost, kMost + 1, int64_t{Sweep::kLargestStar} + 1}) {
    const size_t hubs = (3 * wedges > Sweep::kLargestStar) + (wedges > Sweep::kLargestStar);
    std::vector<uint32_t> expected(static_cast<size_t>(2 + 2 * wedges) - hubs);
    std::iota(expected.begin(), expected.end(), static_cast<uint32_t>(hubs));
    EXPECT_EQ(ownedOf(wedges), expected);
  }
}

// Of few faces all pairs are looked at, of many those with an edge in common.
TEST(Hubs, HaveFoldsAsOtherVerticesDo) {
  for (const uint32_t wedges : {20u, 2000u}) {
    WholePatch<double> w(wheel(wedges));
    std::vector<uint64_t> faces;
    const auto face = [](uint32_t a, uint32_t b) { return uint64_t{a} << 32 | b; };
    for (uint32_t i = 0; i < wedges; ++i) faces.push_back(face(2 + i, 2 + (i + 1) % wedges));
    EXPECT_FALSE(hasFold(w.core.window, 0, faces));
    for (const uint64_t upon : {face(5, 7), face(7, 5), face(5, 6), face(wedges, 2)}) {
      faces.push_back(upon);
      EXPECT_TRUE(hasFold(w.core.window, 0, faces));
      faces.pop_back();
    }
    faces.push_back(face(5, 1));  // square to all others
    EXPECT_FALSE(hasFold(w.core.window, 0, faces));
  }
}

// Their own edges are not needed for that; of the last cells they are.
TEST(Hubs, DoNotKeepATargetFromBeingMet) {
  const TestMesh mesh = wheel(1200);
  for (const double ratio : {0.5, 0.1, 0.01}) {
    const Result result = simplified(mesh, toRatio(ratio));
    expectSound(mesh, result);
    expectReached(result);
  }
}

}  // namespace
}  // namespace tetstream::test
