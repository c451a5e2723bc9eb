// Units do not matter: what is asked for is reached, and the field is followed as closely, whatever
// lengths and values are measured in and wherever the mesh lies. All with default options.
#include <algorithm>
#include <cmath>
#include <map>

#include "field_error.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

// x -> length x + shift, f -> value f.
struct Units {
  double length = 1, value = 1, shift = 0;
  ScalarType type = ScalarType::kFloat64;
};

int unitsSide() {
  return slowRun() ? 4 : 8;
}

using Field = std::function<double(double, double, double)>;

// One of a family: what holds for their mean hangs less on chance.
Field bumps(int phase) {
  return [phase](double x, double y, double z) {
    return std::sin(5 * x + phase) * std::cos(4 * y) + 0.5 * std::sin(6 * z + x - phase);
  };
}

// A box of 1 x 1 x 2, swept along z: 6144 cells, of which 384 are a front.
TestMesh meshIn(const Units& units, const Field& f) {
  const int n = unitsSide();
  const TestMesh grid = fullGrid(n, n, 2 * n, 0.1);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i)
      positions.push_back(units.length * (grid.position(v, i) / n) + units.shift);
  TestMesh mesh = makeMesh(units.type, positions, grid.cells);
  if (!f) return mesh;
  mesh.addField({"f", 1, units.type}, [&](size_t v, int) {
    return units.value *
           f(grid.position(v, 0) / n, grid.position(v, 1) / n, grid.position(v, 2) / n);
  });
  return mesh;
}

SimplifyOptions inFourFronts(double ratio) {
  return toRatio(ratio, 24 * unitsSide() * unitsSide());
}

// The target is reached; the error in units of the field, over the family.
double reachedWithError(const Units& units) {
  const int fields = slowRun() ? 1 : 4;
  double sum = 0;
  for (int phase = 0; phase < fields; ++phase) {
    const TestMesh mesh = meshIn(units, bumps(phase));
    const Result result = simplified(mesh, inFourFronts(0.1));
    expectSound(mesh, result);
    expectReached(result);
    const double error = fieldErrors(mesh, result.out.mesh)[0] / units.value;
    sum += error * error;
  }
  return std::sqrt(sum / fields);
}

void expectSameError(const std::vector<Units>& all, double share = 0.02) {
  if (slowRun()) share = 0.5;  // of a hundred cells each counts
  static std::map<ScalarType, double> known;
  if (!known.count(all[0].type)) known[all[0].type] = reachedWithError({1, 1, 0, all[0].type});
  const double expected = known[all[0].type];
  EXPECT_GT(expected, 0.02);
  EXPECT_LT(expected, slowRun() ? 1 : 0.2);  // of a range of 3
  for (const Units& units : all) {
    SCOPED_TRACE(textOf("length %g, value %g, shift %g, type %d", units.length, units.value,
                        units.shift, static_cast<int>(units.type)));
    const double error = reachedWithError(units);
    EXPECT_NEAR(error, expected, share * expected);
  }
}

// ------------------------------------------------------------------------------------- tests

// Powers of two change no bit of a mantissa.
void expectSameCells(ScalarType type) {
  const Units plain = {1, 1, 0, type};
  const Result expected = simplified(meshIn(plain, bumps(0)), inFourFronts(0.1));
  for (double length : {0x1p30, 0x1p-30}) {
    SCOPED_TRACE(length);
    const Result scaled = simplified(meshIn({length, 1, 0, type}, bumps(0)), inFourFronts(0.1));
    expectReached(scaled);
    const TestMesh &a = expected.out.mesh, &b = scaled.out.mesh;
    ASSERT_TRUE(a.cells == b.cells);
    ASSERT_EQ(a.vertexCount(), b.vertexCount());
    for (size_t v = 0; v < a.vertexCount(); ++v) {
      for (int i = 0; i < 3; ++i) ASSERT_EQ(length * a.position(v, i), b.position(v, i));
      ASSERT_EQ(a.field(0, v), b.field(0, v));
    }
  }
}
TEST(SimplifierUnitsOfLength, GiveTheSameCellsIfTheyArePowersOfTwo) {
  expectSameCells(k64);
  expectSameCells(k32);
}

TEST(SimplifierUnitsOfLength, LeaveTheErrorAsItIs) {
  expectSameError({{1e9, 1, 0, k64}, {1e-9, 1, 0, k64}});
}
TEST(SimplifierUnitsOfTheField, LeaveTheErrorAsItIs) {
  expectSameError({{1, 1e30, 0, k64}, {1, 1e-30, 0, k64}});
}
TEST(SimplifierUnits, NearTheEndsOfFloat32LeaveTheErrorAsItIs) {
  expectSameError({{1, 0x1p100, 0, k32}, {1, 0x1p-100, 0, k32}});
}
// Other units round every number of the mesh anew: another mesh, whose result is another draw.
TEST(SimplifierUnits, ThatRoundTheMeshToFloat32AnewChangeTheErrorByChanceOnly) {
  expectSameError({{1e9, 1e-30, 0, k32}, {1e-9, 1e30, 0, k32}}, 0.15);
}
// 1e4 extents away: 12 digits are left for what lies within one extent.
TEST(SimplifierPlace, FarFromTheOriginLeavesTheErrorAsItIs) {
  expectSameError({{1, 1, 1e4, k64}, {1e-9, 1, -1e-5, k64}});
}

// ------------------------------------------------------------------- fields that say little

void expectReachedIn(Mode mode, ScalarType type, const Field& f) {
  const TestMesh mesh = meshIn({1, 1, 0, type}, f);
  SimplifyOptions options = inFourFronts(0.1);
  options.mode = mode;
  const Result result = simplified(mesh, options);
  expectSound(mesh, result);
  expectReached(result);
}

// In the other modes, too, whatever the default is.
void expectReachedFor(const Field& f) {
  expectReachedIn(SimplifyOptions().mode, k32, f);
  expectReachedIn(Mode::kPaper, k64, f);
  expectReachedIn(Mode::kQueue, k32, f);
}

TEST(SimplifierTargetInAFewFronts, IsReachedForAFlatField) {
  expectReachedFor([](double, double, double) { return 273.15; });
}
TEST(SimplifierTargetInAFewFronts, IsReachedForAFieldThatIsZero) {
  expectReachedFor([](double, double, double) { return 0.0; });
}
TEST(SimplifierTargetInAFewFronts, IsReachedForALinearField) {
  expectReachedFor([](double x, double y, double z) { return 2 * x - y + 0.5 * z + 100; });
}
TEST(SimplifierTargetInAFewFronts, IsReachedForAFieldWhoseHalfIsFlat) {
  expectReachedFor([](double x, double, double) { return std::max(0.0, x - 0.5); });
}
TEST(SimplifierTargetInAFewFronts, IsReachedWithoutAnyField) {
  expectReachedFor({});
}

}  // namespace
}  // namespace tetstream::test
