// Walls that are a cell or two thick: nearly all vertices lie on faces, and cells that have become
// thin cannot move away from them.
#include <cmath>

#include "field_error.h"
#include "simplify_testing.h"
#include "tasks.h"
#include "thin_cells.h"

namespace tetstream::test {
namespace {

int cubesAlong() {
  return slowRun() ? 12 : 16;
}

// Columns of 2 x 2 cubes, next to each other in four regions.
int64_t columnOf(const TestMesh& mesh, size_t cell) {
  double centre[2] = {0, 0};
  for (size_t k = 0; k < 4; ++k)
    for (int i = 0; i < 2; ++i)
      centre[i] += mesh.position(static_cast<size_t>(mesh.cells[4 * cell + k]), i) / 4;
  return static_cast<int64_t>(centre[0] / 2) % 2 + 2 * (static_cast<int64_t>(centre[1] / 2) % 2);
}

TestMesh withWaves(TestMesh mesh) {
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return std::sin(0.4 * x) * std::cos(0.3 * y) + 0.05 * z * std::sin(0.2 * x * z);
  });
  return mesh;
}

TestMesh body() {
  return withWaves(fullGrid(cubesAlong(), cubesAlong(), cubesAlong()));
}

TestMesh columns() {
  TestMesh mesh = body();
  mesh.addIntegerCellData("body", [&](size_t c) { return columnOf(mesh, c); });
  return mesh;
}

SimplifyOptions toCells(double ratio, double error) {
  SimplifyOptions options = toRatio(ratio, 0);
  options.error = error;
  return options;
}

// Four films of one cell's height between thick layers.
TestMesh films() {
  const TestMesh grid = fullGrid(16, 16, 8);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    const double z = grid.position(v, 2);
    const double thick = std::ceil(z / 2), thin = std::floor(z / 2);
    for (int i = 0; i < 2; ++i) positions.push_back(grid.position(v, i));
    positions.push_back(4 * thick + 0.02 * thin);
  }
  TestMesh mesh = withWaves(makeMesh(ScalarType::kFloat64, positions, grid.cells));
  mesh.addIntegerCellData("layer", [&](size_t c) {
    double z = 0;
    for (size_t k = 0; k < 4; ++k)
      z += grid.position(static_cast<size_t>(grid.cells[4 * c + k]), 2) / 4;
    return static_cast<int64_t>(z);
  });
  return mesh;
}

// A price on cells below 10 degrees, and flips, though the input has none of them.
TEST(Walls, AreReducedAsFarAsTheirThinCellsAllow) {
  const TestMesh mesh = columns();
  const Result tenth = simplified(mesh, toCells(0.1, 0)),
               twentieth = simplified(mesh, toCells(0.05, 0));
  expectSound(mesh, tenth);
  expectSound(mesh, twentieth);
  expectReached(tenth);
  EXPECT_GT(tenth.report.flips, 0);
  EXPECT_LT(shareBelow(tenth.out.mesh, 10), 0.03);  // without 0.049
  EXPECT_LT(twentieth.report.cells_out, 1500);      // without 1709
  EXPECT_EQ(simplified(body(), toCells(0.1, 0)).report.flips, 0);
}

// Any number of threads and any cut of the stream gives the same; a budget and small meshes have no
// flips, whose memory is not planned.
TEST(Walls, AreReducedInTheSameWayHoweverTheyCome) {
  const TestMesh mesh = columns();
  for (const int64_t window : {int64_t{0}, static_cast<int64_t>(mesh.cellCount()) / 2}) {
    if (slowRun() && window == 0) continue;
    SimplifyOptions options = toRatio(0.1, window);
    const Result one = simplified(mesh, options);
    EXPECT_GT(one.report.flips, 0);
    Cut cut;
    cut.batch_cells = 77;
    EXPECT_TRUE(simplified(mesh, options, cut).out.allBytes() == one.out.allBytes());
    const Tasks tasks(3);
    options.tasks = &tasks;
    EXPECT_TRUE(simplified(mesh, options).out.allBytes() == one.out.allBytes());
  }
  SimplifyOptions within = toCells(0.1, 0);
  within.memory_bytes = 16 << 20;
  EXPECT_EQ(simplified(mesh, within).report.flips, 0);
  TestMesh small = withWaves(fullGrid(9, 9, 9));
  small.addIntegerCellData("body", [&](size_t c) { return columnOf(small, c); });
  EXPECT_EQ(simplified(small, toCells(0.1, 0)).report.flips, 0);
}

// The floor of angles gives way where little else is legal, with a bound on the error, too.
TEST(Walls, AreReducedToABoundOnTheErrorThatIsFar) {
  const TestMesh mesh = films();
  const Result by_error = simplified(mesh, toCells(0, 30));
  EXPECT_EQ(by_error.out.problem, "");
  EXPECT_EQ(by_error.report.reached, "error");
  EXPECT_LT(by_error.report.cells_out, 250);  // with the floor 491
}

// What is not reached changes little: of one target by chance up to a tenth, of several less.
TEST(Walls, LoseNothingToABoundBesideATarget) {
  const TestMesh mesh = films();
  if (slowRun()) {  // of so few runs chance would say more
    EXPECT_EQ(simplified(mesh, toCells(0.05, 30)).report.reached, "ratio");
    return;
  }
  double error_alone = 0, error_both = 0;
  for (const double ratio : {0.05, 0.06, 0.07, 0.08}) {
    const Result alone = simplified(mesh, toCells(ratio, 0)),
                 both = simplified(mesh, toCells(ratio, 30));
    expectReached(both);
    EXPECT_EQ(both.report.reached, "ratio");
    error_alone += fieldErrors(mesh, alone.out.mesh)[0];
    error_both += fieldErrors(mesh, both.out.mesh)[0];
  }
  EXPECT_LT(error_both, 1.03 * error_alone);
}

}  // namespace
}  // namespace tetstream::test
