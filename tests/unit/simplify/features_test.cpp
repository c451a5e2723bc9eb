// What a user wants to stay: ridges. Labels and locks are in faces_test.cpp.
#include <cmath>
#include <set>

#include "ways_testing.h"

namespace tetstream::test {
namespace {

// A full grid has its sides at 0 and at its numbers of cubes.
struct Box {
  int n[3];
  int sidesAt(const Place& p, double tolerance) const {
    int sides = 0;
    for (size_t i = 0; i < 3; ++i)
      sides += std::fabs(p[i]) <= tolerance || std::fabs(p[i] - n[i]) <= tolerance;
    return sides;
  }
};

void expectRidgesStay(const TestMesh& mesh, const Box& box, const TestMesh& out) {
  std::set<Place> corners;
  for (size_t v = 0; v < out.vertexCount(); ++v) {
    const Place p = placeOf(out, static_cast<int64_t>(v));
    const int sides = box.sidesAt(p, 1e-3);
    EXPECT_EQ(box.sidesAt(p, 0) >= 2, sides >= 2) << "a vertex near an edge is not on it";
    if (box.sidesAt(p, 0) == 3) corners.insert(p);
  }
  EXPECT_EQ(corners.size(), 8u);
  EXPECT_LT(out.vertexCount(), mesh.vertexCount() / 2);
}

TEST(SimplifierFeatures, KeepCornersAndEdgesOfABoxExactly) {
  const int n = slowRun() ? 4 : 8;
  const TestMesh mesh = shakenInside(n);
  for (const Way& way : kWays)
    for (int64_t window : {0, 400}) {
      SimplifyOptions options = way.toRatio(0.1, window);
      options.feature_angle = 45;
      const Result result = simplified(mesh, options);
      expectSound(mesh, result);
      expectRidgesStay(mesh, {{n, n, n}}, result.out.mesh);
      expectFlips(result.report, way);
    }
}

}  // namespace
}  // namespace tetstream::test
