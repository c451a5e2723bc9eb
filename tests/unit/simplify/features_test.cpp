// What a user wants to stay: ridges. Labels and locks are in faces_test.cpp.
#include <array>
#include <cmath>
#include <set>

#include "simplify_testing.h"

namespace tetstream::test {
namespace {

using Place = std::array<double, 3>;

Place placeOf(const TestMesh& mesh, int64_t v) {
  const auto row = static_cast<size_t>(v);
  return {mesh.position(row, 0), mesh.position(row, 1), mesh.position(row, 2)};
}

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

void expectRidgesStay(const TestMesh& mesh, const Box& box, const TestMesh& out, int64_t least) {
  std::set<Place> corners;
  int64_t on_edges = 0;
  for (size_t v = 0; v < out.vertexCount(); ++v) {
    const Place p = placeOf(out, static_cast<int64_t>(v));
    const int sides = box.sidesAt(p, 1e-3);
    EXPECT_EQ(box.sidesAt(p, 0) >= 2, sides >= 2) << "a vertex near an edge is not on it";
    if (box.sidesAt(p, 0) == 3) corners.insert(p);
    on_edges += sides == 2;
  }
  EXPECT_EQ(corners.size(), 8u);
  EXPECT_GE(on_edges, least);
  EXPECT_LT(out.vertexCount(), mesh.vertexCount() / 2);
}

TEST(SimplifierFeatures, KeepCornersAndEdgesOfABoxExactly) {
  const int n = slowRun() ? 4 : 8;
  const TestMesh mesh = fullGrid(n, n, n);
  for (Mode mode : kModes)
    for (int64_t window : {0, 400}) {
      SimplifyOptions options = toRatio(0.1, window, mode);
      options.feature_angle = 45;
      const Result result = simplified(mesh, options);
      expectSound(mesh, result);
      expectRidgesStay(mesh, {{n, n, n}}, result.out.mesh, 0);
    }
}

}  // namespace
}  // namespace tetstream::test
