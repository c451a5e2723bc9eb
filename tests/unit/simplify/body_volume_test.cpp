// The volume inside the boundary, of meshes without regions.
#include <algorithm>
#include <cmath>

#include "mesh_facts.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

constexpr ScalarType k64 = ScalarType::kFloat64;

// A cube of n^3, made round: its faces' middles go out to a sphere, or, hollow, in.
TestMesh rounded(int n, double bulge, double unit = 1) {
  const TestMesh grid = fullGrid(n, n, n);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    double x[3], most = 0, square = 0;
    for (int i = 0; i < 3; ++i) {
      x[i] = grid.position(v, i) / n * 2 - 1;
      most = std::max(most, std::fabs(x[i]));
      square += x[i] * x[i];
    }
    const double far = square > 0 ? 1 + bulge * (std::sqrt(3) * most / std::sqrt(square) - 1) : 1;
    for (double at : x) positions.push_back(unit * far * at);
  }
  TestMesh mesh = makeMesh(k64, positions, grid.cells);
  addPositionField(mesh, {"f", 1, k64}, [unit](double x, double y, double z) {
    return std::sin(2 * x / unit) + y / unit * z / unit;
  });
  return mesh;
}

double changeOfVolume(const TestMesh& mesh, const SimplifyOptions& options) {
  const Result result = simplified(mesh, options);
  expectSound(mesh, result);
  expectReached(result);
  return factsOf(result.out.mesh).volume / factsOf(mesh).volume - 1;
}

TEST(BodyVolume, IsKeptWhereTheBoundaryBends) {
  for (double bulge : {0.5, -0.3}) {
    const TestMesh mesh = rounded(slowRun() ? 8 : 16, bulge);
    for (double ratio : {0.3, 0.1}) {
      EXPECT_NEAR(changeOfVolume(mesh, toRatio(ratio)), 0, 1e-4) << bulge << " " << ratio;
      EXPECT_NEAR(changeOfVolume(mesh, toRatio(ratio, slowRun() ? 1500 : 6000)), 0, 1e-4)
          << bulge << " " << ratio;
    }
  }
}

// As Vo et al. 2007 have it a body that is round shrinks.
TEST(BodyVolume, IsNotForThePaper) {
  SimplifyOptions paper = toRatio(0.1);
  paper.mode = Mode::kPaper;
  EXPECT_LT(changeOfVolume(rounded(slowRun() ? 8 : 16, 0.5), paper), -1e-3);
}

TEST(BodyVolume, IsKeptInAnyUnit) {
  for (double unit : {1e-60, 1e60})
    EXPECT_NEAR(changeOfVolume(rounded(8, 0.5, unit), toRatio(0.2)), 0, 1e-4) << unit;
}

// The field goes with the boundary where that is moved: of a linear one nothing is lost.
TEST(BodyVolume, CostsALinearFieldNothing) {
  TestMesh mesh = rounded(slowRun() ? 8 : 12, 0.5);
  addPositionField(mesh, {"g", 1, k64},
                   [](double x, double y, double z) { return 3 * x - 2 * y + z; });
  SimplifyOptions options = toRatio(0.2);
  options.fields = {{"g", 1}};
  const Result result = simplified(mesh, options);
  const size_t g = 1;
  for (size_t v = 0; v < result.out.mesh.vertexCount(); ++v) {
    const TestMesh& out = result.out.mesh;
    const double there = 3 * out.position(v, 0) - 2 * out.position(v, 1) + out.position(v, 2);
    EXPECT_NEAR(out.field(g, v), there, 1e-6);
  }
}

}  // namespace
}  // namespace tetstream::test
