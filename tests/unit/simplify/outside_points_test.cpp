// Places outside a body belong to the cell that is nearest.
#include "outside_points.h"

#include <cmath>

#include "cell_faces.h"
#include "random_simplex.h"
#include "triangle.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

double distanceToFaces(const TestMesh& mesh, const double place[3]) {
  double least = 1e300;
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    for (const auto& face : kOpposite) {
      double corners[9], at[3];
      for (size_t k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i)
          corners[3 * k + static_cast<size_t>(i)] =
              mesh.position(static_cast<size_t>(mesh.cells[4 * c + face[k]]), i);
      least = std::min(least, squaredDistance(corners, place, at));
    }
  return std::sqrt(least);
}

// Round a cube of 3 x 3 x 3, up to its own length away.
TEST(OutsidePoints, AreFoundWhereACellIsNearest) {
  constexpr uint32_t kPoints = 200;
  const WholeWindow<double> whole(fullGrid(3, 3, 3, 0.2));
  const double scale = whole.core.scale[0];
  OutsidePoints<double> outside(whole.core);
  Random random(5);
  std::vector<std::vector<double>> places;
  while (places.size() < kPoints) {
    std::vector<double> x = {9 * uniform(random) - 3, 9 * uniform(random) - 3,
                             9 * uniform(random) - 3};
    if (std::max({std::fabs(x[0] - 1.5), std::fabs(x[1] - 1.5), std::fabs(x[2] - 1.5)}) < 1.75)
      continue;
    const double scaled[3] = {scale * x[0], scale * x[1], scale * x[2]};
    outside.add(static_cast<uint32_t>(places.size()), scaled);
    places.push_back(x);
  }
  size_t met = 0;
  outside.forNearest([&](const OutsidePoints<double>::Found& found) {
    ++met;
    double square = 0;
    for (int i = 0; i < 3; ++i) {
      double at = 0;
      for (size_t k = 0; k < 4; ++k) {
        EXPECT_GE(found.weights[k], 0);
        at += found.weights[k] *
              whole.core.window.values(whole.core.window.mesh.corners(found.cell)[k])[i];
      }
      const double d = at - places[found.point][static_cast<size_t>(i)];
      square += d * d;
    }
    EXPECT_NEAR(std::sqrt(square), distanceToFaces(whole.mesh, places[found.point].data()), 1e-12);
  });
  EXPECT_EQ(met, kPoints);
}

TEST(OutsidePoints, AreNotFoundFarFromAllCells) {
  const WholeWindow<double> whole(fullGrid(2, 2, 2));
  OutsidePoints<double> outside(whole.core);
  const double far[3] = {1e6 * whole.core.scale[0], 0, 0};
  const double near[3] = {-0.1 * whole.core.scale[0], 0, 0};
  outside.add(1, far);
  outside.add(2, near);
  size_t met = 0;
  outside.forNearest([&](const OutsidePoints<double>::Found& found) {
    ++met;
    EXPECT_EQ(found.point, 2u);
  });
  EXPECT_EQ(met, 1u);
}

}  // namespace
}  // namespace tetstream::test
