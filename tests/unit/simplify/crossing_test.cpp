// The boundary of what comes out does not pass through itself.
#include <cmath>

#include "crossings.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

// Walls a few cubes thick on both sides of a gyroid, with a staircase for a boundary: where cells
// are few beside the bends the best place for a vertex often lies behind the next fold.
TestMesh gyroid(int n) {
  const double step = 4 * std::acos(-1) / n;  // two periods
  const auto is_wall = [step](int x, int y, int z) {
    const double a = (x + 0.5) * step, b = (y + 0.5) * step, c = (z + 0.5) * step;
    const double g =
        std::sin(a) * std::cos(b) + std::sin(b) * std::cos(c) + std::sin(c) * std::cos(a);
    return std::fabs(g) < 0.55;
  };
  TestMesh mesh = cubes(n, n, n, is_wall, 0.1);
  addPositionField(mesh, {"f", 1, k64}, [step](double x, double y, double z) {
    return std::sin(step * x) + std::cos(step * (y + z));
  });
  return mesh;
}

// Without a look at what is beside the new faces there were 32 to 186 such pairs.
TEST(Crossing, DoesNotComeOfCollapses) {
  const TestMesh mesh = gyroid(slowRun() ? 12 : 20);
  ASSERT_EQ(crossingPairs(mesh), 0);
  for (Mode mode : kModes)
    for (double ratio : {0.3, 0.02}) {
      const Result result = simplified(mesh, toRatio(ratio, 0, mode));
      expectSound(mesh, result);
      EXPECT_EQ(crossingPairs(result.out.mesh), 0) << static_cast<int>(mode) << " " << ratio;
    }
}

}  // namespace
}  // namespace tetstream::test
