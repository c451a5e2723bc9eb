// The error that is told, over the volume, where it is easily missed: all of it in a small, finely
// meshed part; more of it than quadrics tell; lengths beyond the window's units.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "field_error.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

// Of a scalar field, in percent of its range.
double errorOverVolume(const TestMesh& original, const TestMesh& result) {
  const CellSearch cells(result);
  double sum = 0, all = 0, low = original.field(0, 0), high = low;
  for (size_t c = 0; c < original.cellCount(); ++c) {
    double x[3] = {0, 0, 0}, error = 0;
    for (size_t k = 0; k < 4; ++k) {
      const auto v = static_cast<size_t>(original.cells[4 * c + k]);
      for (int i = 0; i < 3; ++i) x[i] += original.position(v, i) / 4;
      error -= original.field(0, v) / 4;
      low = std::min(low, original.field(0, v));
      high = std::max(high, original.field(0, v));
    }
    const InCell at = cells.find(x);
    for (size_t k = 0; k < 4; ++k)
      error +=
          at.weights.of[k] * result.field(0, static_cast<size_t>(result.cells[4 * at.cell + k]));
    const double volume = std::fabs(cellVolume(original, c));
    sum += volume * error * error;
    all += volume;
  }
  return 100 * std::sqrt(sum / all) / (high - low);
}

using Place = std::array<double, 3>;
TestMesh mapped(const TestMesh& grid, const std::function<Place(const Place&)>& map) {
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (const double x : map({grid.position(v, 0), grid.position(v, 1), grid.position(v, 2)}))
      positions.push_back(x);
  return makeMesh(ScalarType::kFloat64, positions, grid.cells);
}

// A cube whose cells grow a thousand times from its centre on, round which the field has its waves.
TestMesh gradedMesh() {
  const int n = slowRun() ? 10 : 16;
  TestMesh mesh = mapped(fullGrid(n, n, n), [n](const Place& p) {
    Place x = {2 * p[0] / n - 1, 2 * p[1] / n - 1, 2 * p[2] / n - 1};
    const double m = std::max({std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])});
    for (double& at : x) at *= std::pow(1000, m - 1);
    return x;
  });
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return std::exp(-1e4 * (x * x + y * y + z * z)) * std::cos(300 * x);
  });
  return mesh;
}

TEST(ErrorSample, FindsWhatASmallPartHas) {
  const TestMesh mesh = gradedMesh();
  for (const double percent : {0.003, 0.01}) {
    SimplifyOptions options;
    options.error = percent;
    const Result result = simplified(mesh, options);
    EXPECT_LT(result.report.cells_out, result.report.cells_in);
    EXPECT_LE(result.report.estimated_error, percent);
    const double error = errorOverVolume(mesh, result.out.mesh);
    EXPECT_LE(error, percent);
    EXPECT_GE(result.report.estimated_error, 0.9 * error);
  }
}

// Gradients of cells so long are taken for less than they are.
TEST(ErrorSample, TellsMoreThanQuadricsWhereItIsMore) {
  const int n = slowRun() ? 8 : 20;
  TestMesh mesh = mapped(fullGrid(n, n, 3), [n](const Place& p) {
    return Place{p[0] / n, p[1] / n, 100 * p[2]};
  });
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return std::sin(5 * x) * std::cos(4 * y) + 0.001 * z;
  });
  const Result result = simplified(mesh, toRatio(0.3));
  const double error = errorOverVolume(mesh, result.out.mesh);
  EXPECT_GT(error, 0.01);
  EXPECT_GE(result.report.estimated_error, 0.9 * error);
}

// A wire of one cell across in fifteen turns, along which the field has its waves.
TestMesh wound() {
  const int n = 1000;
  TestMesh mesh = mapped(fullGrid(1, 1, n), [](const Place& p) {
    const double angle = 30 * std::acos(-1) * p[2] / n, radius = 5 + 0.5 * p[0];
    return Place{radius * std::cos(angle), radius * std::sin(angle), angle / 3 + 0.5 * p[1]};
  });
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double, double, double z) { return std::sin(1.5 * z); });
  return mesh;
}

// Its ends draw in, and of a thin body much lies outside: that counts, as what is nearest has it,
// neither for nothing nor for all that quadrics tell.
TEST(ErrorSample, TellsOfWhatLiesOutside) {
  const TestMesh mesh = wound();
  for (const int64_t window : {0, 1000})
    for (const double ratio : {0.2, 0.1, window > 0 ? 0.08 : 0.03}) {
      const Result result = simplified(mesh, toRatio(ratio, window));
      const double error = errorOverVolume(mesh, result.out.mesh);
      EXPECT_GE(result.report.estimated_error, 0.8 * error) << window << " " << ratio;
      EXPECT_LE(result.report.estimated_error, 3 * error) << window << " " << ratio;
    }
}

// Of cells like the first ones, the last are too large to be counted.
TEST(ErrorSample, LeavesOutLengthsBeyondAllUnits) {
  std::vector<double> positions;
  std::vector<int64_t> cells;
  for (int c = 0; c < 400; ++c) {
    const double size = c < 200 ? 1e-160 * (1 + 0.001 * c) : 1e155;
    for (int k = 0; k < 4; ++k) {
      for (int i = 1; i < 4; ++i) positions.push_back(k == i ? size : 0);
      cells.push_back(4 * c + k);
    }
  }
  TestMesh mesh = makeMesh(ScalarType::kFloat64, positions, cells);
  mesh.addField({"f", 1, ScalarType::kFloat64}, [](size_t v, int) { return double(v % 7); });
  Cut cut;
  cut.batch_cells = 50;
  SimplifyOptions options = toRatio(0.5, 64);
  EXPECT_TRUE(std::isfinite(simplified(mesh, options, cut).report.estimated_error));
  options.ratio = 0;
  options.error = 1;
  EXPECT_TRUE(std::isfinite(simplified(mesh, options, cut).report.estimated_error));
}

}  // namespace
}  // namespace tetstream::test
