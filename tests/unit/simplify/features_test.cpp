// What a user wants to stay: ridges. Labels and locks are in faces_test.cpp.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
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

// A grid of n^3 cubes, n even, with a crack: in the plane x = n / 2 the points of the square inside
// are there twice, once for each side.
TestMesh cracked(int n) {
  const TestMesh grid = fullGrid(n, n, n);
  std::vector<double> positions;
  std::vector<int64_t> cells = grid.cells, twin(grid.vertexCount(), -1);
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) positions.push_back(grid.position(v, i));
  for (size_t v = 0; v < twin.size(); ++v) {
    const Place p = placeOf(grid, static_cast<int64_t>(v));
    const auto inside = [n](double x) { return x > n / 4 && x < n - n / 4; };
    if (p[0] != n / 2 || !inside(p[1]) || !inside(p[2])) continue;
    twin[v] = static_cast<int64_t>(positions.size() / 3);
    positions.insert(positions.end(), p.begin(), p.end());
  }
  for (size_t c = 0; c < grid.cellCount(); ++c) {
    double middle = 0;
    for (size_t k = 0; k < 4; ++k) middle += placeOf(grid, cells[4 * c + k])[0] / 4;
    for (size_t k = 0; k < 4; ++k) {
      int64_t& v = cells[4 * c + k];
      if (middle > n / 2 && twin[static_cast<size_t>(v)] >= 0) v = twin[static_cast<size_t>(v)];
    }
  }
  return makeMesh(grid.schema.position_type, positions, cells);
}

// Of the faces of one cell that lie in the plane of the crack.
double crackArea(const TestMesh& mesh, int n) {
  std::map<std::array<int64_t, 3>, int> faces;
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    for (size_t j = 0; j < 4; ++j) {
      std::array<int64_t, 3> face;
      for (size_t k = 0; k < 3; ++k) face[k] = mesh.cells[4 * c + (j + k + 1) % 4];
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  double area = 0;
  for (const auto& [face, cells] : faces) {
    const Place p = placeOf(mesh, face[0]), q = placeOf(mesh, face[1]), r = placeOf(mesh, face[2]);
    const auto isOff = [n](const Place& x) { return std::fabs(x[0] - n / 2) > 0.1; };
    if (cells != 1 || isOff(p) || isOff(q) || isOff(r)) continue;
    area += std::fabs((q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1])) / 2;
  }
  return area;
}

// Both sides of a crack lie in one plane, so that only its rim tells where it ends. The default
// modes know it, whatever the field.
TEST(SimplifierFeatures, KeepTheRimOfACrack) {
  const int n = slowRun() ? 8 : 12;
  TestMesh mesh = cracked(n);
  mesh.addField({"f", 1, ScalarType::kFloat64}, [&](size_t v, int) {
    const Place p = placeOf(mesh, static_cast<int64_t>(v));
    return std::sin(p[0] / 3) + std::cos(p[1] / 4) * p[2] / n;
  });
  const double side = n - 2 * (n / 4), area = crackArea(mesh, n);
  ASSERT_GT(area, 1.8 * side * side);  // but for faces with three points on the rim
  for (const Way& way : kWays) {
    if (way.mode != Mode::kSweep) continue;
    const Result result = simplified(mesh, way.toRatio(0.1));
    EXPECT_LT(result.out.mesh.cellCount(), mesh.cellCount() / 8);
    EXPECT_NEAR(crackArea(result.out.mesh, n) / area, 1, 0.005);
  }
  SimplifyOptions none = kWays[0].toRatio(0.1);
  none.feature_angle = 180;
  EXPECT_LT(crackArea(simplified(mesh, none).out.mesh, n) / area, 0.99);
}

}  // namespace
}  // namespace tetstream::test
