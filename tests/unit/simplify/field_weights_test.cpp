// The weights of several fields against each other: a smooth one counts for more beside a rough
// one, whatever their units, where enough of the mesh is known to tell.
#include "field_weights.h"

#include <cmath>

#include "field_error.h"
#include "shapes.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

// A cube with a field that is steep on some planes, and one of long waves along them; units are of
// the length and of the second field.
TestMesh wavesMesh(int n, double length = 1, double unit = 1, double from = 0) {
  TestMesh mesh = fullGrid(n, n, n, 0.15);
  addPositionField(mesh, {"rough", 1, k64},
                   [n](double x, double, double) { return std::tanh(4 * std::sin(9 * x / n)); });
  addPositionField(mesh, {"smooth", 3, k64}, [=](double, double y, double z) {
    return from + unit * std::sin(2 * y / n) * std::cos(3 * z / n);
  });
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) mesh.setPosition(v, i, length * mesh.position(v, i));
  return mesh;
}

int waves() {
  return slowRun() ? 8 : 10;
}
int moreWaves() {
  return slowRun() ? 8 : 12;
}

std::vector<double> weightsFor(const TestMesh& mesh, const SimplifyOptions& options,
                               const Cut& cut = {}) {
  Recorder out;
  Simplifier simplifier(options, out, {});
  MeshStream stream(mesh, cut);
  copyStream(stream, simplifier);
  return simplifier.pilot().balance.fields;
}

TEST(FieldWeights, AreLargerForSmootherFields) {
  const TestMesh mesh = wavesMesh(waves());
  for (bool box : {false, true}) {
    Cut cut;
    cut.say_box = box;
    const std::vector<double> weights = weightsFor(mesh, toRatio(0.2), cut);
    ASSERT_EQ(weights.size(), 2u);
    EXPECT_EQ(weights[0], 1);
    EXPECT_GE(weights[1], 4);
    EXPECT_LE(weights[1], 64);
  }
}

TEST(FieldWeights, AreThoseOfTheFieldsInAnyUnit) {
  const std::vector<double> weights = weightsFor(wavesMesh(waves()), toRatio(0.2));
  EXPECT_EQ(weightsFor(wavesMesh(waves(), 1e60), toRatio(0.2)), weights);
  EXPECT_EQ(weightsFor(wavesMesh(waves(), 1e-60, 1e60), toRatio(0.2)), weights);
  EXPECT_EQ(weightsFor(wavesMesh(waves(), 1, 1e-90), toRatio(0.2)), weights);
  EXPECT_EQ(weightsFor(wavesMesh(waves(), 1, 1e3, 1e6), toRatio(0.2)), weights);
}

// There is nothing that weights could do for them.
TEST(FieldWeights, AreOneForWhatHasNoErrorAndForWhatIsCarried) {
  TestMesh mesh = wavesMesh(waves());
  mesh.addField({"constant", 1, k64}, [](size_t, int) { return 3.25; });
  addPositionField(mesh, {"linear", 1, k64},
                   [](double x, double y, double z) { return 0.3 * x - 0.7 * y + z; });
  mesh.addField({"number", 1, ScalarType::kInt64}, [](size_t v, int) { return double(v % 7); });
  const std::vector<double> weights = weightsFor(mesh, toRatio(0.2));
  ASSERT_EQ(weights.size(), 5u);
  EXPECT_GE(weights[1], 4);
  for (size_t f : {0, 2, 3, 4}) EXPECT_EQ(weights[f], 1) << f;
  SimplifyOptions options = toRatio(0.2);
  options.fields = {{"rough", 1}, {"linear", 1}};
  EXPECT_EQ(weightsFor(mesh, options)[1], 1);
}

// Differences that are no number are left out, and so are ranges that cannot be divided by.
TEST(FieldWeights, AreOneForNumbersTooLargeOrTooSmall) {
  for (double unit : {1.7e308, 1e-310}) {
    TestMesh mesh = wavesMesh(waves());
    addPositionField(mesh, {"extreme", 1, k64}, [=](double x, double y, double z) {
      return unit * std::sin(x + 2 * y) * std::cos(3 * z);
    });
    const std::vector<double> weights = weightsFor(mesh, toRatio(0.2));
    ASSERT_EQ(weights.size(), 3u);
    EXPECT_EQ(weights[0], 1) << unit;
    EXPECT_GE(weights[1], 4) << unit;
    EXPECT_EQ(weights[2], 1) << unit;
  }
}

TEST(FieldWeights, AreNotFoundWhereTheyAreNotWanted) {
  const TestMesh mesh = wavesMesh(waves());
  SimplifyOptions none = toRatio(0.2), error, one = toRatio(0.2);
  none.balance = BalanceUse::kNever;
  error.error = 5;
  one.fields = {{"smooth", 1}};
  for (const SimplifyOptions& options : {none, error, one, toRatio(0.2, 0, Mode::kPaper)})
    EXPECT_EQ(weightsFor(mesh, options), std::vector<double>());
}

// The first window of many may be unlike the others.
TEST(FieldWeights, AreNotFoundInASmallPartOfTheMesh) {
  const TestMesh mesh = wavesMesh(12);
  EXPECT_EQ(weightsFor(mesh, toRatio(0.2, 2000)), std::vector<double>());
  EXPECT_EQ(weightsFor(mesh, toRatio(0.2, 4000)).size(), 2u);
  Cut cut;
  cut.say_counts = false;
  EXPECT_EQ(weightsFor(mesh, toRatio(0.2, 4000), cut), std::vector<double>());
}

TEST(FieldWeights, AreOneForAMeshOfFewVertices) {
  EXPECT_EQ(weightsFor(wavesMesh(3), toRatio(0.5)), std::vector<double>({1, 1}));
}

TEST(FieldWeights, MakeTheSmoothFieldLoseLess) {
  const TestMesh mesh = wavesMesh(moreWaves());
  SimplifyOptions none = toRatio(0.15);
  none.balance = BalanceUse::kNever;
  const Result with = simplified(mesh, toRatio(0.15)), without = simplified(mesh, none);
  expectSound(mesh, with);
  expectReached(with);
  EXPECT_NE(with.report.balance.find("smoother fields count for more: smooth"), std::string::npos)
      << with.report.balance;
  const std::vector<double> errors = fieldErrors(mesh, with.out.mesh),
                            before = fieldErrors(mesh, without.out.mesh);
  EXPECT_LT(errors[1], 0.8 * before[1]);
  EXPECT_LT(errors[0], 1.25 * before[0]);
}

// The boundary of a jagged body costs much, of which a share of the fields' range is allowed: a
// field that counts 256 times left the others a sixteenth of it, and the body more than twice the
// cells that were wanted.
TEST(FieldWeights, PutNoTargetOutOfReach) {
  constexpr double kWave = 4 * 3.14159265358979;
  const int n = 20;
  TestMesh mesh = cubes(n, n, n, [](int i, int j, int k) {
    const double x = kWave * (i + 0.5) / n, y = kWave * (j + 0.5) / n, z = kWave * (k + 0.5) / n;
    return std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x) > 0.3;
  });
  addPositionField(mesh, {"u", 1, k64}, [](double x, double y, double z) {
    return std::sin(5 * x / n) * std::cos(4 * y / n) + z / n * (z / n);
  });
  addPositionField(mesh, {"v", 1, k64},
                   [](double x, double y, double) { return y / n + 0.1 * x / n * x / n; });
  const Result result = simplified(mesh, toRatio(0.02));
  EXPECT_NE(result.report.balance.find("count for more: v"), std::string::npos)
      << result.report.balance;
  expectReached(result);
}

// A weight that is given counts besides.
TEST(FieldWeights, MultiplyThoseThatAreGiven) {
  const TestMesh mesh = wavesMesh(moreWaves());
  SimplifyOptions options = toRatio(0.15);
  const std::vector<double> even = fieldErrors(mesh, simplified(mesh, options).out.mesh);
  options.fields = {{"rough", 100}, {"smooth", 1}};
  const std::vector<double> heavy = fieldErrors(mesh, simplified(mesh, options).out.mesh);
  EXPECT_LT(heavy[0], even[0]);
  EXPECT_GT(heavy[1], 1.5 * even[1]);
}

// What a pilot found holds for windows that see too little, and is told.
TEST(FieldWeights, AreTakenFromAPilot) {
  const TestMesh mesh = wavesMesh(moreWaves());
  Pilot pilot;
  pilot.balance.fields = {1, 64};
  Result result;
  Simplifier simplifier(toRatio(0.15, 2000), result.out, {});
  simplifier.follow(pilot);
  MeshStream stream(mesh, {});
  copyStream(stream, simplifier);
  EXPECT_EQ(simplifier.pilot().balance.fields, pilot.balance.fields);
  EXPECT_EQ(simplifier.report().balance, "smoother fields count for more: smooth 64 times");
  const std::vector<double> errors = fieldErrors(mesh, result.out.mesh),
                            without =
                                fieldErrors(mesh, simplified(mesh, toRatio(0.15, 2000)).out.mesh);
  EXPECT_LT(errors[1], 0.8 * without[1]);
}

TEST(FieldWeights, OfManyAreToldOfTheFirst) {
  Balance balance;
  std::vector<Column> fields;
  for (int f = 0; f < 9; ++f) {
    fields.push_back({"f" + std::to_string(f), 1, k64});
    balance.fields.push_back(f == 0 ? 1 : 8);
  }
  EXPECT_EQ(inWords(balance, false, fields),
            "smoother fields count for more: f1 8 times, f2 8 times, f3 8 times, f4 8 times, f5 8 "
            "times, f6 8 times and 2 others");
  balance.fields.back() = 1;
  const std::string words = inWords(balance, false, fields);
  EXPECT_TRUE(words.ends_with("f6 8 times and 1 other")) << words;
}

}  // namespace
}  // namespace tetstream::test
