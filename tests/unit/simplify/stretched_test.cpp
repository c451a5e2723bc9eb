// Meshes whose cells are nearly all as thin as each other: the floor of their angles does not stand
// against what is asked for, so that domain and field stay what they are.
#include <algorithm>
#include <cmath>

#include "simplify_testing.h"
#include "thin_cells.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

// With layers 1 / flatness high, shuffled: an order of its own would lead the sweep along them.
TestMesh flattened(const TestMesh& grid, double flatness,
                   const std::function<double(const double*)>& field) {
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) positions.push_back(grid.position(v, i) / (i == 2 ? flatness : 1));
  TestMesh mesh = makeMesh(ScalarType::kFloat64, positions, grid.cells);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [&](double x, double y, double z) {
    const double place[3] = {x, y, z * flatness};
    return field(place);
  });
  return shuffled(mesh, 3);
}

// Cubes of five cells, each the mirror of its neighbours.
TestMesh fives(int n) {
  std::vector<double> positions;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        positions.insert(positions.end(), {double(i), double(j), double(k)});
  std::vector<int64_t> cells;
  const int corners[5][4] = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const auto& cell : corners)
          for (int corner : cell) {
            const int c = (i + j + k) % 2 ? 7 - corner : corner;
            cells.push_back((int64_t{k + c / 4} * (n + 1) + j + c / 2 % 2) * (n + 1) + i + c % 2);
          }
  return makeMesh(ScalarType::kFloat64, positions, cells);
}

// The domain to a thousandth of its volume, the field to a percent or so.
void expectUnharmed(const TestMesh& mesh, const Result& result, double error,
                    double volume = slowRun() ? 1e-2 : 1e-3) {
  expectSound(mesh, result);
  expectReached(result);
  const MeshFacts before = factsOf(mesh), after = factsOf(result.out.mesh);
  EXPECT_EQ(topologyChange(before, after), "");
  EXPECT_NEAR(after.volume, before.volume, volume * before.volume);
  EXPECT_LT(result.report.estimated_error, error);
}

// All cells are between 3.2 and 4.6 degrees. With a floor of 3 they lost a quarter of the volume.
TEST(Stretched, MeshesHaveAFloorFarBelowTheirCells) {
  const int n = slowRun() ? 10 : 20;
  const TestMesh mesh = flattened(fives(n), 25, [n](const double* x) {
    return std::sin(5 * x[0] / n) * std::cos(4 * x[1] / n) + std::sin(3 * x[0] / n);
  });
  ASSERT_EQ(shareBelow(mesh, 3), 0);
  ASSERT_EQ(shareBelow(mesh, 5), 1);
  for (double ratio : {0.1, 0.02}) {
    const Result result = simplified(mesh, toRatio(ratio));
    expectUnharmed(mesh, result, slowRun() ? 5 : 2);
    // With the floor lowered only once it stands in the way, 3.1 and 3.3 to a collapse.
    EXPECT_LT(static_cast<double>(result.report.rejected_orientation),
              2.8 * static_cast<double>(result.report.collapses))
        << ratio;
    EXPECT_EQ(shareBelow(result.out.mesh, 0.99), 0) << ratio;
  }
}

// A sea of depth 1 at most over an uneven ground, so wide, its layers finer towards the surface;
// the field does not change with depth.
TestMesh sea(int n, double width) {
  const TestMesh grid = fullGrid(n, n, n / 3);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    const double x = grid.position(v, 0) / n, y = grid.position(v, 1) / n;
    const double z = 3 * grid.position(v, 2) / n;
    const double depth = 0.02 + std::pow(std::sin(3 * x) * std::sin(2 * y), 2);
    positions.insert(positions.end(), {width * x, width * y, -z * z * depth});
  }
  TestMesh mesh = makeMesh(k64, positions, grid.cells);
  addPositionField(mesh, {"f", 1, k64}, [width](double x, double y, double) {
    return std::exp(-20 * (std::pow(x / width - 0.4, 2) + std::pow(y / width - 0.6, 2)));
  });
  return inStreamOrder(mesh);
}

// With a twentieth of a degree as the least floor two and more edges were refused to a collapse,
// and the error was half as large again.
TEST(Stretched, MeshesThinnerThanTheUsualFloorsHaveLowerOnes) {
  const TestMesh mesh = sea(slowRun() ? 15 : 24, 2000);
  ASSERT_GT(shareBelow(mesh, 0.05), 0.7);
  const Result result = simplified(mesh, toRatio(0.05));
  expectUnharmed(mesh, result, slowRun() ? 5 : 0.3, 1e-2);  // the ground of a few cells bends
  EXPECT_LT(result.report.rejected_orientation, 3 * result.report.collapses / 2);
}

// Cubes of six cells, one cube after the other, each from the `first` of its cells on; 25 times as
// high as wide.
TestMesh tall(const TestMesh& grid, size_t first) {
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) positions.push_back(grid.position(v, i) * (i == 2 ? 25 : 1));
  std::vector<int64_t> cells;
  for (size_t c = 0; c < grid.cellCount(); ++c) {
    const int64_t* const cell = &grid.cells[4 * (c / 6 * 6 + (c + first) % 6)];
    cells.insert(cells.end(), cell, cell + 4);
  }
  TestMesh mesh = makeMesh(k64, positions, cells);
  addPositionField(mesh, {"f", 1, k64},
                   [](double x, double, double z) { return std::sin(z / 80) + x / 100; });
  return inStreamOrder(mesh);
}

// Sixteen layers of one cell took twenty times as long, and had thinner cells in the end.
TEST(Stretched, MeshesAreToTheSolversModeAsToAny) {
  const TestMesh mesh =
      flattened(fives(10), 25, [](const double* x) { return std::sin(x[0] / 2) * x[1]; });
  SimplifyOptions options = toRatio(0.1);
  const Result usual = simplified(mesh, options);
  options.shape = Shape::kSolver;
  const Result solvers = simplified(mesh, options);
  EXPECT_EQ(solvers.out.mesh.cells, usual.out.mesh.cells);
  EXPECT_EQ(solvers.out.mesh.positions.bytes, usual.out.mesh.positions.bytes);
  EXPECT_GT(usual.report.collapses, 0);
}

// A third of the cells have 2.3 degrees, the others 45: which of a cube's are looked at for the
// floor must not depend on where in it they come. With every sixteenth, three of the six, the floor
// was 3, far more than there were below it already, and cells became as good as flat.
TEST(Stretched, MeshesHaveTheirFloorInWhateverOrderTheirCellsCome) {
  const TestMesh grid = slowRun() ? fullGrid(10, 10, 8) : fullGrid(16, 16, 8);
  for (size_t first = 0; first < 6; first += oneIn(3)) {
    const TestMesh mesh = tall(grid, first);
    ASSERT_GT(shareBelow(mesh, 3), 0.3);
    ASSERT_EQ(shareBelow(mesh, 2), 0);
    const Result result = simplified(mesh, toRatio(0.5));
    expectUnharmed(mesh, result, 1);
    EXPECT_EQ(shareBelow(result.out.mesh, 0.49), 0) << first;
  }
}

// Whether the cell has an angle below 3 degrees.
bool isThin(const TestMesh& mesh, size_t cell) {
  std::vector<double> positions;
  for (size_t j = 0; j < 4; ++j)
    for (int i = 0; i < 3; ++i)
      positions.push_back(mesh.position(static_cast<size_t>(mesh.cells[4 * cell + j]), i));
  return shareBelow(makeMesh(k64, positions, {0, 1, 2, 3}), 3) > 0;
}

// Cells that are thin come first, and then as each 17th, as long as there are some.
TestMesh withThinAtSeventeenths(const TestMesh& mesh) {
  std::vector<size_t> thin, others;
  for (size_t c = 0; c < mesh.cellCount(); ++c) (isThin(mesh, c) ? thin : others).push_back(c);
  TestMesh ordered = mesh;
  for (size_t c = 0, t = 0; c < mesh.cellCount(); ++c) {
    const bool takes_thin = c % 17 == 0 && t < thin.size();
    const size_t from = takes_thin ? thin[t++] : others[c - t];
    std::copy_n(&mesh.cells[4 * from], 4, &ordered.cells[4 * c]);
  }
  return inStreamOrder(ordered);
}

// Fewer than one in a hundred is thin, but all that would be looked at where there are many cells:
// of so few all are.
TEST(Stretched, MeshesOfFewCellsHaveTheirFloorWhereverThinOnesCome) {
  const TestMesh grid = fullGrid(10, 10, 10);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) positions.push_back(grid.position(v, i));
  for (size_t k = 3; k <= 7; k += 2) {  // inside, pulled next to the vertex behind it
    const size_t v = k * (121 + 11 + 1);
    for (size_t i = 0; i < 3; ++i)
      positions[3 * v + i] += 0.99 * (positions[3 * (v + 1) + i] - positions[3 * v + i]);
  }
  const TestMesh mesh = withThinAtSeventeenths(makeMesh(k64, positions, grid.cells));
  ASSERT_GT(shareBelow(mesh, 1), 0.002);
  ASSERT_LT(shareBelow(mesh, 3), 0.009);
  EXPECT_EQ(WholeWindow<double>(mesh, SimplifyOptions{}).core.thin.degrees, 3);
}

// A field that bends across the layers wants cells that are thinner still: where nearly all edges
// are refused the floor gives way. Held, it left 13 % of error and seven eighths of the volume.
TEST(Stretched, MeshesKeepTheirDomainWhereTheirFloorGivesWay) {
  const int n = slowRun() ? 16 : 24;
  const TestMesh mesh = flattened(fullGrid(n, n, n / 2), 18, [n](const double* x) {
    return 10 * std::tanh(16 * x[2] / n) * (1 + 0.2 * std::sin(5 * x[1] / n));
  });
  const Result result = simplified(mesh, toRatio(0.02));
  expectUnharmed(mesh, result, 1);
  EXPECT_GT(shareBelow(result.out.mesh, 0.99), 0);
}

}  // namespace
}  // namespace tetstream::test
