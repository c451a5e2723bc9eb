// The boundary of what comes out does not pass through itself, and does not lie on itself.
#include <cmath>
#include <iterator>

#include "crossings.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

// Walls a few cubes thick on both sides of a gyroid, with a staircase for a boundary: where cells
// are few beside the bends the best place for a vertex often lies behind the next fold.
TestMesh gyroid(int n, double unit = 1) {
  const double step = 4 * std::acos(-1) / n;  // two periods
  const auto is_wall = [step](int x, int y, int z) {
    const double a = (x + 0.5) * step, b = (y + 0.5) * step, c = (z + 0.5) * step;
    const double g =
        std::sin(a) * std::cos(b) + std::sin(b) * std::cos(c) + std::sin(c) * std::cos(a);
    return std::fabs(g) < 0.55;
  };
  TestMesh mesh = cubes(n, n, n, is_wall, 0.1);
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) mesh.setPosition(v, i, unit * mesh.position(v, i));
  addPositionField(mesh, {"f", 1, k64}, [step = step / unit](double x, double y, double z) {
    return std::sin(step * x) + std::cos(step * (y + z));
  });
  return mesh;
}

// Without a look at what is beside the new faces there were 32 to 186 such pairs.
TEST(Crossing, DoesNotComeOfCollapses) {
  const TestMesh mesh = gyroid(slowRun() ? 10 : 20);
  ASSERT_EQ(crossingPairs(mesh), 0);
  for (Mode mode : kModes)
    for (double ratio : {0.02, 0.3}) {
      if (slowRun() && ratio > 0.1) continue;
      const Result result = simplified(mesh, toRatio(ratio, 0, mode));
      expectSound(mesh, result);
      EXPECT_EQ(crossingPairs(result.out.mesh), 0) << static_cast<int>(mode) << " " << ratio;
    }
}

TEST(Crossing, DoesNotComeInAnyUnit) {
  const double units[] = {1e-60, 1.1, 1e60, 3};
  for (size_t i = 0; i < std::size(units); i += oneIn(4)) {
    const double unit = units[i];
    const Result result = simplified(gyroid(12, unit), toRatio(0.1));
    EXPECT_EQ(crossingPairs(result.out.mesh), 0) << unit;
  }
}

// Struts three cubes thick that cross each other. Where a vertex of a bend goes into the strut that
// it leads to, a side of that is laid on the plane of the other: no cell is turned over, and no
// volume lost. So two edges were folded at both ratios.
TestMesh struts(int n) {
  TestMesh mesh = cubes(
      n, n, n, [](int x, int y, int z) { return (x % 11 < 3) + (y % 11 < 3) + (z % 11 < 3) >= 2; });
  addPositionField(mesh, {"f", 1, k64}, [](double x, double y, double z) {
    return std::exp(-0.002 * (x * x + y * y + z * z)) + std::sin(0.1 * (x - y));
  });
  return mesh;
}

TEST(Crossing, LaysNoFaceOnAnother) {
  const TestMesh mesh = struts(slowRun() ? 14 : 47);
  ASSERT_EQ(foldedEdges(mesh), 0);
  for (const double ratio : {0.04, 0.015}) {
    if (slowRun() && ratio < 0.04) continue;
    const Result result = simplified(mesh, toRatio(ratio));
    expectSound(mesh, result);
    EXPECT_EQ(foldedEdges(result.out.mesh), 0) << ratio;
  }
}

// A toothed wheel: each tooth is a neighbour of the hub's two ends, which have all cells. To go
// through these for each collapse took 33 seconds for one.
TEST(Crossing, IsNotLookedForRoundVerticesOfAllCells) {
  const int64_t n = slowRun() ? 2000 : 10000;
  std::vector<double> positions = {0, 0, 1, 0, 0, -1};
  std::vector<int64_t> cells;
  for (int64_t i = 0; i < n; ++i) {
    const double angle = 2 * std::acos(-1) * double(i) / double(n);
    const double far = 1 + double(i * 7 % 5) / double(n);
    positions.insert(positions.end(), {far * std::cos(angle), far * std::sin(angle), 0});
    cells.insert(cells.end(), {1, 0, 2 + i, 2 + (i + 1) % n});
  }
  TestMesh mesh = makeMesh(k64, positions, cells);
  addPositionField(mesh, {"f", 1, k64}, [](double x, double y, double) { return x * y; });
  const TestMesh stream = inStreamOrder(mesh);
  for (Mode mode : kModes) {
    const Result result = simplified(stream, toRatio(0.3, 0, mode));
    expectSound(stream, result);
    expectReached(result);
  }
}

}  // namespace
}  // namespace tetstream::test
