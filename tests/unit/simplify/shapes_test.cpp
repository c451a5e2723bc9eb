// The shapes of the cells that come out: none thinner than the floor where none was, and no larger
// share of thin ones where the input has some.
#include <cmath>

#include "simplify_testing.h"
#include "star_kernels.h"

namespace tetstream::test {
namespace {

// Of the cells, those with a dihedral angle below, in degrees.
double shareBelow(const TestMesh& mesh, double degrees) {
  std::vector<double> places;
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int i = 0; i < 4; ++i) places.push_back(i < 3 ? mesh.position(v, i) : 0);
  size_t thin = 0;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    StarCell cell{};
    uint32_t v[4];
    for (size_t j = 0; j < 4; ++j) v[j] = static_cast<uint32_t>(mesh.cells[4 * c + j]);
    std::copy_n(v + 1, 3, cell.t);
    const ThinAngle angle(degrees);
    StarShape shape = starShape(&places[size_t{4} * v[0]], places.data(), 4, 1, &cell, 1, angle);
    if (!shape.positive) {
      std::swap(cell.t[0], cell.t[1]);
      shape = starShape(&places[size_t{4} * v[0]], places.data(), 4, 1, &cell, 1, angle);
    }
    EXPECT_TRUE(shape.positive);
    thin += shape.thin;
  }
  return static_cast<double>(thin) / static_cast<double>(mesh.cellCount());
}

// A box in cubes of 1, of whose layers one in `period` is flat: 1 / flatness high.
TestMesh layered(int n, int period, double flatness) {
  const TestMesh grid = fullGrid(n, n, 2 * n, 0.05);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    const double z = grid.position(v, 2);
    const double whole = std::floor(z / period), part = z - whole * period;
    positions.push_back(grid.position(v, 0));
    positions.push_back(grid.position(v, 1));
    positions.push_back(whole * (period - 1 + 1 / flatness) +
                        (part < 1 ? part / flatness : part - 1 + 1 / flatness));
  }
  TestMesh mesh = makeMesh(ScalarType::kFloat64, positions, grid.cells);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return 0.1 * std::sin(0.3 * x) * std::cos(0.2 * y) + std::sin(2 * z);
  });
  return mesh;
}

int side() {
  return slowRun() ? 6 : 12;
}

int64_t fourFronts() {
  return int64_t{28} * side() * side();
}

TEST(Shapes, AreNotThinnerThanTheFloorWhereNoneWas) {
  const TestMesh mesh = layered(side(), 1, 1);
  ASSERT_EQ(shareBelow(mesh, 10), 0);
  for (double ratio : {0.5, 0.1}) {
    const Result result = simplified(mesh, toRatio(ratio, fourFronts()));
    expectReached(result);
    EXPECT_EQ(shareBelow(result.out.mesh, 2.99), 0) << ratio;
  }
}

// At 0.1 it was 0.96 of the input's share when thin cells had no price, 0.58 with it.
TEST(Shapes, AreNoWorseWhereSomeAreThin) {
  for (double flatness : {12.0, 70.0}) {
    const TestMesh mesh = layered(side(), 6, flatness);
    const double thin = shareBelow(mesh, 10), very_thin = shareBelow(mesh, 1.01);
    ASSERT_GT(thin, 0.1);
    for (double ratio : {0.5, 0.1}) {
      const Result result = simplified(mesh, toRatio(ratio, fourFronts()));
      expectReached(result);
      EXPECT_LE(shareBelow(result.out.mesh, 10), (ratio < 0.5 ? 0.75 : 1) * thin) << ratio;
      EXPECT_LE(shareBelow(result.out.mesh, 1), very_thin) << ratio;
    }
  }
}

}  // namespace
}  // namespace tetstream::test
