// The weight of the boundary in walls of a few cells, where few vertices or none are inside.
#include <cmath>
#include <string>

#include "crossings.h"
#include "field_error.h"
#include "shapes.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

// A pipe whose wall is one cube thick, or more.
TestMesh pipe(int around, int along, int thick = 1) {
  const TestMesh grid = fullGrid(around, along, thick);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    const double angle = 5.5 * grid.position(v, 0) / around;
    const double radius = 10 + grid.position(v, 2);
    positions.insert(positions.end(),
                     {radius * std::cos(angle), radius * std::sin(angle), grid.position(v, 1)});
  }
  TestMesh mesh = makeMesh(k64, positions, grid.cells);
  addPositionField(mesh, {"f", 1, k64}, [along](double x, double y, double z) {
    return std::sin(6 * z / along) + 0.02 * x * y / 10;
  });
  return mesh;
}

// By less than so many times the error that it has where nothing is lowered.
void expectFieldFollowed(const TestMesh& mesh, double ratio, double times) {
  const Result with = simplified(mesh, toRatio(ratio));
  SimplifyOptions unbalanced = toRatio(ratio);
  unbalanced.balance = BalanceUse::kNever;
  const Result without = simplified(mesh, unbalanced);
  expectSound(mesh, with);
  expectReached(with);
  EXPECT_NE(with.report.balance.find("the boundary counts 1/"), std::string::npos);
  EXPECT_LT(fieldErrors(mesh, with.out.mesh)[0], times * fieldErrors(mesh, without.out.mesh)[0]);
  EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(with.out.mesh)), "");
}

// All of its vertices lie on the boundary, which bends around it, and the field along it.
TEST(BalancedWalls, FollowASmoothField) {
  expectFieldFollowed(slowRun() ? pipe(30, 40) : pipe(40, 60), 0.1, 0.65);
}

// A third of its vertices lie inside; next to none of those that are left do, and the boundary
// costs as much with any weight.
TEST(BalancedWalls, FollowASmoothFieldWhereTwoCellsThick) {
  const int n = slowRun() ? 24 : 36;
  expectFieldFollowed(pipe(n, n, 2), 0.1, 0.7);
  expectFieldFollowed(pipe(n, n, 2), 0.02, 0.6);
}

// Of three materials, one round the other, whose interfaces bend as the boundary does: each of them
// takes what would be left of the others and of the inside. Lowered one after the other they left
// the field 0.54 and 0.74 times the error.
TEST(BalancedWalls, FollowASmoothFieldBetweenLayers) {
  const int n = slowRun() ? 24 : 36;
  TestMesh mesh = pipe(n, n, 6);
  mesh.addIntegerCellData("layer", [&](size_t c) {
    double x = 0, y = 0;
    for (size_t j = 0; j < 4; ++j) {
      x += mesh.position(static_cast<size_t>(mesh.cells[4 * c + j]), 0) / 4;
      y += mesh.position(static_cast<size_t>(mesh.cells[4 * c + j]), 1) / 4;
    }
    return static_cast<int64_t>((std::hypot(x, y) - 10) / 2);
  });
  expectFieldFollowed(mesh, 0.1, 0.45);
  expectFieldFollowed(mesh, 0.02, 0.5);
}

// A sheet of one cube's thickness that is rolled up, with as much air between its layers.
TestMesh roll(int along) {
  const int around = 80, turns = 3;
  const double thick = 2 * std::acos(-1) / around, far = 2 * std::acos(-1);
  const TestMesh grid = fullGrid(turns * around, 1, along);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    const double turn = grid.position(v, 0) / around;
    const double radius = 1 + thick * (grid.position(v, 1) + 2 * turn);
    positions.insert(positions.end(), {radius * std::cos(turn * far), radius * std::sin(turn * far),
                                       thick * grid.position(v, 2)});
  }
  TestMesh mesh = makeMesh(k64, positions, grid.cells);
  addPositionField(mesh, {"f", 1, k64}, [](double x, double y, double z) {
    return std::sin(3 * z) * x + std::exp(-10 * ((y - 1) * (y - 1) + (z - 2) * (z - 2)));
  });
  return mesh;
}

// Where little is left there is no room for the boundary to count less: 87 pairs of faces crossed.
TEST(BalancedWalls, DoNotGoThroughEachOther) {
  const TestMesh mesh = roll(slowRun() ? 20 : 80);
  for (const double ratio : {0.1, 0.02}) {
    const Result result = simplified(mesh, toRatio(ratio));
    expectReached(result);
    const bool is_lowered = result.report.balance.find("the boundary") != std::string::npos;
    EXPECT_EQ(is_lowered, ratio > 0.05) << result.report.balance;
    EXPECT_EQ(crossingPairs(result.out.mesh), 0) << ratio;
  }
}

}  // namespace
}  // namespace tetstream::test
