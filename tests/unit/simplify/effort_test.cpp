// More time gives smaller errors and fewer thin cells.
#include <algorithm>
#include <cmath>

#include "field_error.h"
#include "simplify_testing.h"
#include "tasks.h"
#include "thin_cells.h"

namespace tetstream::test {
namespace {

// A layer across the mesh, steep along a sphere.
TestMesh withALayer(int n) {
  TestMesh mesh = fullGrid(n, n, n, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [n](double x, double y, double z) {
    return std::tanh(std::hypot(x, y, z) - 0.8 * n) + 0.05 * x;
  });
  return mesh;
}

SimplifyOptions with(Effort effort, double ratio, int64_t window = 0) {
  SimplifyOptions options = toRatio(ratio, window);
  options.effort = effort;
  return options;
}

TEST(Effort, LowersTheErrorAndLeavesFewerThinCells) {
  const TestMesh mesh = withALayer(slowRun() ? 14 : 20);
  for (const int64_t window : {int64_t{0}, static_cast<int64_t>(mesh.cellCount()) / 3}) {
    if (slowRun() && window == 0) continue;
    const double ratio = window == 0 ? 0.3 : 0.05;  // held whole, a smaller one has as much without
    const Result normal = simplified(mesh, with(Effort::kNormal, ratio, window));
    const Result high = simplified(mesh, with(Effort::kHigh, ratio, window));
    expectSound(mesh, high);
    expectReached(high);
    EXPECT_LT(fieldErrors(mesh, high.out.mesh)[0], 0.95 * fieldErrors(mesh, normal.out.mesh)[0])
        << window;
    EXPECT_LT(shareBelow(high.out.mesh, 10), 0.7 * shareBelow(normal.out.mesh, 10)) << window;
  }
}

// Thin cells have their price from where a tenth of a mesh that is held whole is left, and cells
// are flipped; not on the way to more. Where memory is tight they have it in every window.
TEST(Effort, IsMadeWhereFewCellsAreLeft) {
  const TestMesh mesh = withALayer(slowRun() ? 10 : 16);
  const Result few = simplified(mesh, with(Effort::kNormal, 0.02));
  expectSound(mesh, few);
  expectReached(few);
  EXPECT_GT(few.report.flips, 0);
  EXPECT_EQ(simplified(mesh, with(Effort::kNormal, 0.11)).report.flips, 0);
  const auto third = static_cast<int64_t>(mesh.cellCount()) / 3;
  const Result in_parts = simplified(mesh, with(Effort::kNormal, 0.02, third));
  EXPECT_EQ(in_parts.report.flips, 0);
  EXPECT_LT(shareBelow(few.out.mesh, 10), 0.7 * shareBelow(in_parts.out.mesh, 10));
  SimplifyOptions options = with(Effort::kNormal, 0.02);
  for (const int64_t kilobytes : {16 << 10, slowRun() ? 1 << 10 : 2 << 10}) {
    options.ratio = 0.02;
    options.memory_bytes = kilobytes << 10;
    const Result within = simplified(mesh, options);
    expectSound(mesh, within);
    expectReached(within);
    EXPECT_GT(within.report.flips, 0);
    EXPECT_LT(fieldErrors(mesh, within.out.mesh)[0], 1.3 * fieldErrors(mesh, few.out.mesh)[0]);
    options.ratio = 0.11;
    EXPECT_EQ(simplified(mesh, options).report.flips, 0);
  }
  const Tasks tasks(3);
  SimplifyOptions threads = with(Effort::kNormal, 0.02);
  threads.tasks = &tasks;
  EXPECT_TRUE(simplified(mesh, threads).out.allBytes() == few.out.allBytes());
}

// A jump across the mesh: what costs next to nothing goes in a few passes, and what costs much more
// has to wait until shapes bar the way no longer.
TEST(Effort, IsMadeWherePassesTakeNextToNothing) {
  const int n = slowRun() ? 12 : 20;
  TestMesh mesh = fullGrid(n, n, n, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [n](double x, double y, double z) {
    return std::hypot(x, y, z) < 0.8 * n ? 1.0 : 0.0;
  });
  const Result normal = simplified(mesh, with(Effort::kNormal, 0.15));
  expectSound(mesh, normal);
  expectReached(normal);
  EXPECT_GT(normal.report.flips, 0);
  const Result high = simplified(mesh, with(Effort::kHigh, 0.15));
  EXPECT_LT(fieldErrors(mesh, normal.out.mesh)[0], 1.15 * fieldErrors(mesh, high.out.mesh)[0]);
}

TEST(Effort, GoesWithShapesForSolvers) {
  const TestMesh mesh = withALayer(slowRun() ? 6 : 12);
  SimplifyOptions options = with(Effort::kHigh, 0.1);
  options.shape = Shape::kSolver;
  const Result result = simplified(mesh, options);
  expectSound(mesh, result);
  EXPECT_EQ(shareBelow(result.out.mesh, 9.99), 0);
}

double rangeOf(const TestMesh& mesh) {
  double low = mesh.field(0, 0), high = low;
  for (size_t v = 1; v < mesh.vertexCount(); ++v) {
    low = std::min(low, mesh.field(0, v));
    high = std::max(high, mesh.field(0, v));
  }
  return high - low;
}

TEST(Effort, KeepsALimitOfTheError) {
  const TestMesh mesh = withALayer(slowRun() ? 9 : 12);
  SimplifyOptions options;
  options.error = 1;
  options.effort = Effort::kHigh;
  const Result result = simplified(mesh, options);
  EXPECT_EQ(result.report.reached, "error");
  EXPECT_LT(result.out.mesh.cellCount(), mesh.cellCount() / 2);
  EXPECT_LE(100 * fieldErrors(mesh, result.out.mesh)[0], rangeOf(mesh));
}

TEST(Effort, IsForSweepsAlone) {
  for (Mode mode : {Mode::kPaper, Mode::kQueue}) {
    SimplifyOptions options = with(Effort::kHigh, 0.5);
    options.mode = mode;
    const auto [status, text] = thrownBy([&] { simplified(withALayer(2), options); });
    EXPECT_EQ(status, Status::kUnsupported);
    EXPECT_NE(text.find("effort"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace tetstream::test
