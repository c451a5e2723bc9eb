// Sides, ends and layers that lie across an axis stay there, to the last bit: who looks for what
// lies on them compares coordinates.
#include <cmath>
#include <iterator>

#include "axis_planes.h"
#include "faces.h"
#include "random.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

constexpr double kUnit = 0.1, kOrigin = 0.3;  // no side has a coordinate that bits have exactly

double sideAt(int k) {
  return kOrigin + kUnit * k;
}

// From -0.5 to 0.5.
double centred(Random& random) {
  return random.below(1 << 20) / double{1 << 20} - 0.5;
}

// n cubes along each axis, of which only vertices inside and `mayMove` are jittered.
TestMesh box(int n, ScalarType type, const Keep& mayMove) {
  TestMesh mesh = fullGrid(n, n, n, 0, type);
  Random random(7);
  for (size_t v = 0; v < mesh.vertexCount(); ++v) {
    int at[3];
    for (int i = 0; i < 3; ++i) at[i] = static_cast<int>(mesh.position(v, i));
    const auto inside = [n](int x) { return x > 0 && x < n; };
    const bool moves =
        inside(at[0]) && inside(at[1]) && inside(at[2]) && mayMove(at[0], at[1], at[2]);
    for (int i = 0; i < 3; ++i)
      mesh.setPosition(v, i, sideAt(at[i]) + (moves ? 0.2 * kUnit * centred(random) : 0));
  }
  addPositionField(mesh, {"f", 1, type}, [](double x, double y, double z) {
    return std::sin(4 * x) * std::cos(3 * y) + std::exp(z);
  });
  return mesh;
}

// The area of the listed faces, and of it what lies across the axes at coordinates that
// isSide(axis, x) has.
struct Areas {
  double all = 0, on_sides = 0;
};
template <class IsSide>
Areas areasOf(const TestMesh& mesh, const std::vector<Face>& faces, IsSide isSide) {
  Areas areas;
  for (const Face& face : faces) {
    const Place a = placeOf(mesh, face[0]), b = placeOf(mesh, face[1]), c = placeOf(mesh, face[2]);
    double e[3], f[3], normal[3];
    bool on_side = false;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<size_t>(i);
      e[i] = b[k] - a[k];
      f[i] = c[k] - a[k];
      on_side |= isSide(i, a[k]) && a[k] == b[k] && b[k] == c[k];
    }
    cross(e, f, normal);
    const double area = std::sqrt(dot(normal, normal)) / 2;
    areas.all += area;
    if (on_side) areas.on_sides += area;
  }
  return areas;
}

std::vector<Face> boundaryOf(const TestMesh& mesh) {
  std::vector<Face> faces;
  for (const auto& [face, cells] : facesOf(mesh.cells))
    if (cells == 1) faces.push_back(face);
  return faces;
}

double asStored(double x, ScalarType type) {
  return type == k32 ? static_cast<double>(static_cast<float>(x)) : x;
}

SimplifyOptions forSolvers(SimplifyOptions options) {
  options.shape = Shape::kSolver;
  return options;
}

// Without a word on planes a tenth to a third of the area was left on the sides.
TEST(PlaneSides, OfABoxStay) {
  const int n = slowRun() ? 8 : 14;
  for (ScalarType type : {k32, k64}) {
    const TestMesh mesh = box(n, type, [](int, int, int) { return true; });
    const auto is_side = [&](int, double x) {
      return x == asStored(sideAt(0), type) || x == asStored(sideAt(n), type);
    };
    const SimplifyOptions all[] = {toRatio(0.3), toRatio(0.05), toRatio(0.1, 3000),
                                   forSolvers(toRatio(0.1))};
    for (size_t i = 0; i < std::size(all); ++i) {
      const Result result = simplified(mesh, all[i]);
      expectSound(mesh, result);
      const Areas areas = areasOf(result.out.mesh, boundaryOf(result.out.mesh), is_side);
      EXPECT_EQ(areas.on_sides, areas.all) << i << " " << (type == k32);
    }
  }
}

// The ends of a pipe, whose rims go round: what merges with them from the curved side goes there.
TEST(PlaneSides, OfAPipeStay) {
  const int n = slowRun() ? 8 : 12;
  TestMesh mesh = fullGrid(n, n, 2 * n);
  for (size_t v = 0; v < mesh.vertexCount(); ++v) {
    double p[2];
    for (int i = 0; i < 2; ++i) p[i] = 2 * mesh.position(v, i) / n - 1;
    const double radius = std::max(std::fabs(p[0]), std::fabs(p[1])),
                 length = std::hypot(p[0], p[1]);
    for (int i = 0; i < 2; ++i) mesh.setPosition(v, i, length > 0 ? p[i] * radius / length : 0);
    mesh.setPosition(v, 2, sideAt(static_cast<int>(mesh.position(v, 2))));
  }
  addPositionField(mesh, {"f", 1, k64},
                   [](double x, double y, double z) { return x * x + y * std::sin(2 * z); });
  const auto is_end = [&](int axis, double x) {
    return axis == 2 && (x == sideAt(0) || x == sideAt(2 * n));
  };
  for (double ratio : {0.3, 0.1}) {
    const Result result = simplified(mesh, toRatio(ratio));
    expectSound(mesh, result);
    const Areas areas = areasOf(result.out.mesh, boundaryOf(result.out.mesh), is_end);
    EXPECT_NEAR(areas.on_sides, 2 * std::acos(-1), 0.1) << ratio;
    for (size_t v = 0; v < result.out.mesh.vertexCount(); ++v) {
      const double z = result.out.mesh.position(v, 2);
      for (int end : {0, 2 * n})
        EXPECT_TRUE(z == sideAt(end) || std::fabs(z - sideAt(end)) > 0.02 * kUnit) << ratio;
    }
  }
}

// Flat layers, of which the lower is locked where it meets the upper only if it cannot be helped.
TEST(PlaneSides, OfLayersStay) {
  const int n = slowRun() ? 8 : 12, at = n / 3;
  TestMesh mesh = box(n, k64, [at](int, int, int z) { return z != at; });
  mesh.addIntegerCellData("layer", [&](size_t c) {
    double z = 0;
    for (size_t j = 0; j < 4; ++j)
      z += mesh.position(static_cast<size_t>(mesh.cells[4 * c + j]), 2);
    return z / 4 < sideAt(at) ? 1 : 2;
  });
  for (double ratio : {0.3, 0.05}) {
    const Result result = simplified(mesh, toRatio(ratio));
    expectSound(mesh, result);
    std::map<Face, int64_t> labels;
    const TestMesh& out = result.out.mesh;
    std::vector<Face> interface;
    for (int64_t label : {1, 2}) {
      std::vector<int64_t> cells;
      for (size_t c = 0; c < out.cellCount(); ++c)
        if (out.cellInteger(0, c) == label)
          cells.insert(cells.end(), &out.cells[4 * c], &out.cells[4 * c] + 4);
      for (const auto& [face, count] : facesOf(cells))
        if (count == 1 && ++labels[face] == 2) interface.push_back(face);
    }
    const auto is_layer = [&](int axis, double x) { return axis == 2 && x == sideAt(at); };
    const Areas areas = areasOf(out, interface, is_layer);
    EXPECT_EQ(areas.on_sides, areas.all) << ratio;
    EXPECT_NEAR(areas.all, std::pow(n * kUnit, 2), 1e-9);
  }
}

// Sides whose coordinates differ by rounding, as mesh generators leave them.
TEST(PlaneSides, StayAsNearAsTheyWere) {
  const int n = slowRun() ? 8 : 12;
  TestMesh mesh = box(n, k64, [](int, int, int) { return true; });
  Random random(3);
  const auto side_of = [&](double x) {
    return std::fabs(x - sideAt(0)) < 1e-9 ? sideAt(0) : sideAt(n);
  };
  const auto is_side = [&](double x) { return std::fabs(x - side_of(x)) < 1e-9; };
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i)
      if (const double x = mesh.position(v, i); is_side(x))
        mesh.setPosition(v, i, x + 1e-15 * centred(random));
  const Result result = simplified(mesh, toRatio(0.05));
  expectSound(mesh, result);
  for (const Face& face : boundaryOf(result.out.mesh)) {
    bool on_side = false;
    for (size_t i = 0; i < 3; ++i) {
      bool all = true;
      for (int64_t v : face) {
        const double x = placeOf(result.out.mesh, v)[i];
        all &= std::fabs(x - side_of(x)) < 2e-15;
      }
      on_side |= all;
    }
    EXPECT_TRUE(on_side);
  }
}

TEST(AxisPlanes, AreOnePlaneForEachAxis) {
  AxisPlanes<double> planes(1e-6);
  const double a[3] = {1, 0, 0}, b[3] = {1, 1, 0}, c[3] = {1 + 1e-7, 0, 1}, d[3] = {2, 0, 0};
  EXPECT_FALSE(planes.has(0));
  planes.add(a, b, c);
  EXPECT_TRUE(planes.has(0) && planes.hasAll(0));
  EXPECT_FALSE(planes.has(1) || planes.has(2));
  EXPECT_EQ(planes.at(0), 1);
  planes.add(a, b, d);  // z = 0
  EXPECT_TRUE(planes.has(0) && planes.has(2));
  EXPECT_FALSE(planes.hasAll(0) || planes.hasAll(2));
}

TEST(AxisPlanes, AreNoneWhereTwoLieApart) {
  AxisPlanes<float> planes(0);
  const float a[3] = {1, 0, 0}, b[3] = {1, 1, 0}, c[3] = {1, 0, 1};
  const float d[3] = {2, 0, 0}, e[3] = {2, 1, 0}, f[3] = {2, 0, 1};
  planes.add(a, b, c);
  EXPECT_TRUE(planes.has(0));
  planes.add(d, e, f);
  planes.add(a, b, c);
  EXPECT_FALSE(planes.has(0));
}

// One face beside the plane, and it is not alone.
TEST(AxisPlanes, TellOfWhatLiesBeside) {
  AxisPlanes<double> planes(0);
  const double a[3] = {1, 0, 0}, b[3] = {1, 1, 0}, c[3] = {1, 0, 1}, d[3] = {2, 0.5, 0.5};
  planes.add(a, b, c);
  planes.add(b, c, d);
  EXPECT_TRUE(planes.has(0));
  EXPECT_FALSE(planes.hasAll(0));
}

}  // namespace
}  // namespace tetstream::test
