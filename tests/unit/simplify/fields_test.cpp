// Several fields at once: none loses much against being alone, in whatever form and however their
// ranges come to be known; what a field of no extent or of no weight does; values within their
// range; walls across which a field is steep.
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "field_error.h"
#include "simplify_testing.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

int fieldsSide() {
  return slowRun() ? 6 : 10;
}

double front(double x, double y, double z) {
  return std::tanh(3 * std::sin(0.5 * x + 0.2 * z) + y - 5);
}

// A swept box: a front, a smooth pressure, a vector that grows along the sweep, and a tensor.
TestMesh fieldsMesh(ScalarType type = k64, int n = fieldsSide()) {
  TestMesh mesh = fullGrid(n, n, 3 * n, 0.1);
  addPositionField(mesh, {"front", 1, type}, front);
  addPositionField(mesh, {"pressure", 1, type}, [](double x, double y, double z) {
    return 1e5 + x * x + 9 * std::sin(z / 5) * y;
  });
  addPositionField(mesh, {"growing", 3, type}, [](double x, double y, double z) {
    return 1e-3 * std::exp(0.2 * z) * std::sin(0.6 * x + 0.4 * y);
  });
  addPositionField(mesh, {"stress", 6, type}, [](double x, double y, double z) {
    return 40 * std::cos(0.4 * x) * std::sin(0.3 * y + 0.2 * z);
  });
  return mesh;
}

SimplifyOptions measuring(std::vector<std::pair<std::string, double>> fields) {
  SimplifyOptions options = toRatio(0.15, 4000);
  options.fields = std::move(fields);
  return options;
}

std::vector<double> errorsOf(const TestMesh& mesh, const SimplifyOptions& options,
                             const Cut& cut = {}) {
  const Result result = simplified(mesh, options, cut);
  expectSound(mesh, result);
  expectReached(result);
  return fieldErrors(mesh, result.out.mesh);
}

// Of each field simplified alone.
std::vector<double> errorsAlone(const TestMesh& mesh) {
  std::vector<double> errors;
  for (size_t f = 0; f < mesh.fields.size(); ++f)
    errors.push_back(errorsOf(mesh, measuring({{mesh.schema.fields[f].name, 1}}))[f]);
  return errors;
}

double geometricMean(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += std::log(a[i] / b[i]);
  return std::exp(sum / static_cast<double>(a.size()));
}

// Whether the ranges are known from the start, or are met on the way: then what was read before has
// to be carried over, a field at a time.
TEST(SeveralFields, LoseLittleAgainstEachAlone) {
  for (ScalarType type : {k32, k64}) {
    if (slowRun() && type == k32) continue;
    const TestMesh mesh = fieldsMesh(type);
    const std::vector<double> alone = errorsAlone(mesh);
    for (bool box : {true, false}) {
      Cut cut;
      cut.say_box = box;
      const std::vector<double> together = errorsOf(mesh, measuring({}), cut);
      for (size_t f = 0; f < alone.size(); ++f)
        EXPECT_LT(together[f], 3.5 * alone[f]) << mesh.schema.fields[f].name << " box " << box;
      EXPECT_LT(geometricMean(together, alone), 1.8) << "box " << box;
    }
  }
}

// Carried fields alone leave errors that measured ones do not: the test above could not tell
// otherwise.
TEST(SeveralFields, AreFollowedBecauseTheyAreMeasured) {
  const TestMesh mesh = fieldsMesh();
  const std::vector<double> carried = errorsOf(mesh, measuring({{"pressure", 1}}));
  EXPECT_GT(carried[0], 2 * errorsOf(mesh, measuring({{"front", 1}}))[0]);
  EXPECT_GT(carried[3], 2 * errorsOf(mesh, measuring({{"stress", 1}}))[3]);
}

TEST(SeveralFields, GainByTheirWeights) {
  const TestMesh mesh = fieldsMesh();
  const std::vector<double> heavy =
      errorsOf(mesh, measuring({{"front", 1}, {"pressure", 1}, {"growing", 1}, {"stress", 100}}));
  if (slowRun()) return;  // a small one has nothing to spare
  const std::vector<double> even = errorsOf(mesh, measuring({}));
  EXPECT_LT(heavy[3], 0.8 * even[3]);
  EXPECT_GT(heavy[0], even[0]);
}

// A constant measures nothing, wherever it stands; nor do fields that all weigh nothing.
TEST(SeveralFields, OfNoExtentOrWeightLeaveTheOthersAlone) {
  TestMesh mesh = fullGrid(fieldsSide(), fieldsSide(), 2 * fieldsSide(), 0.1);
  addPositionField(mesh, {"flat", 2, k64}, [](double, double, double) { return 0.0; });
  addPositionField(mesh, {"front", 1, k64}, front);
  mesh.addField({"constant", 1, k64}, [](size_t, int) { return 3.25; });
  for (bool box : {true, false}) {
    if (slowRun() && box) continue;
    Cut cut;
    cut.say_box = box;
    const std::vector<double> all = errorsOf(mesh, measuring({}), cut),
                              one = errorsOf(mesh, measuring({{"front", 1}}), cut);
    EXPECT_LT(all[1], 1.1 * one[1]);
    EXPECT_EQ(all[0], 0);
    EXPECT_LT(all[2], 1e-12);
    EXPECT_LT(one[1], 0.5 * errorsOf(mesh, measuring({{"flat", 1}}), cut)[1]);
    errorsOf(mesh, measuring({{"flat", 0}, {"front", 0}, {"constant", 0}}), cut);
  }
}

// A constant field is told, of one that is carried along nothing is.
TEST(SeveralFields, WithoutExtentAreTold) {
  TestMesh mesh = fullGrid(4, 4, 4, 0.1);
  addPositionField(mesh, {"front", 1, k64}, front);
  mesh.addField({"density", 1, k64}, [](size_t, int) { return 1000.0; });
  mesh.addField({"wind", 3, k64}, [](size_t, int i) { return i * 0.1; });
  mesh.addField({"heat", 1, k64}, [](size_t v, int) { return 300 + 0x1p-42 * (v % 2 ? 1 : -1); });
  const auto told = [&mesh](const SimplifyOptions& options) {
    return simplified(mesh, options).report.balance;
  };
  EXPECT_EQ(told(measuring({})), "constant: density, wind; constant but for rounding: heat");
  EXPECT_EQ(told(measuring({{"front", 1}, {"wind", 1}})), "constant: wind");
  EXPECT_EQ(told(measuring({{"front", 1}})), "");
}

// What has a range by which nothing can be divided is not followed.
TEST(SeveralFields, OfARangeOutOfReachAreTold) {
  TestMesh mesh = fullGrid(4, 4, 4, 0.1);
  addPositionField(mesh, {"front", 1, k64}, front);
  mesh.addField({"huge", 1, k64}, [](size_t v, int) { return v % 2 ? 1.7e308 : -1.7e308; });
  mesh.addField({"tiny", 2, k64}, [](size_t v, int i) { return v % 2 ? 1e-310 * i : 0; });
  const Report report = simplified(mesh, measuring({})).report;
  EXPECT_EQ(report.balance, "of too large or too small a range to be followed: huge, tiny");
  EXPECT_EQ(simplified(mesh, measuring({{"front", 1}})).report.balance, "");
}

// Values that are one number but for rounding are as constant as that number.
TEST(SeveralFields, ThatAreConstantButForRoundingLeaveTheOthersAlone) {
  TestMesh mesh = fullGrid(fieldsSide(), fieldsSide(), 2 * fieldsSide(), 0.1);
  addPositionField(mesh, {"front", 1, k64}, front);
  const auto step = [](size_t vertex) { return static_cast<double>(vertex * 7 % 3) - 1; };
  mesh.addField({"temperature", 1, k32}, [&](size_t v, int) { return 300 + 0x1p-15 * step(v); });
  mesh.addField({"gravity", 3, k64},
                [&](size_t v, int i) { return i < 2 ? 0 : -9.81 + 0x1p-44 * step(v); });
  for (bool box : {true, false}) {
    if (slowRun() && box) continue;
    Cut cut;
    cut.say_box = box;
    const std::vector<double> all = errorsOf(mesh, measuring({}), cut),
                              one = errorsOf(mesh, measuring({{"front", 1}}), cut);
    EXPECT_LT(all[0], 1.1 * one[0]) << "box " << box;
  }
}

// A component counts however large and constant another one is, and so do more than a few units.
TEST(SeveralFields, ThatAreSmallBesideAConstantAreMeasured) {
  for (const bool is_wide : {false, true}) {
    TestMesh mesh = fullGrid(fieldsSide(), fieldsSide(), 2 * fieldsSide(), 0.1);
    mesh.addField({"b", 2, k32}, [&](size_t v, int i) {
      const double f = std::tanh(mesh.position(v, 2) - static_cast<double>(fieldsSide()));
      return is_wide ? 300 + 64 * 0x1p-15 * f : i == 0 ? 1000 : 1e-4 * f;
    });
    SimplifyOptions options = toRatio(0.001);
    options.error = 1;
    const Result result = simplified(mesh, options);
    EXPECT_GT(result.out.mesh.cellCount(), 20u) << is_wide;
    EXPECT_GT(result.report.estimated_error, 0.1) << is_wide;
  }
}

// With a field twice all errors count twice: beside it the boundary would count half, were it not
// for its weight.
TEST(SeveralFields, LeaveTheBoundaryItsShare) {
  SimplifyOptions options;
  options.shape_weight = 0;
  TestMesh once = fullGrid(4, 4, 4, 0.1), twice = once, beside_none = once;
  addPositionField(once, {"front", 1, k64}, front);
  for (TestMesh* mesh : {&twice, &beside_none}) addPositionField(*mesh, {"front", 1, k64}, front);
  addPositionField(twice, {"again", 1, k64}, front);
  addPositionField(beside_none, {"constant", 1, k64}, [](double, double, double) { return 7; });
  WholeWindow<double> one(once, options), two(twice, options), same(beside_none, options);
  for (uint32_t v = 0; v < one.core.window.mesh.vertexEnd(); ++v)
    for (int i = 0; i < 6; ++i) {  // the part in space
      const double c = one.core.window.quadric(v)[i];
      EXPECT_NEAR(two.core.window.quadric(v)[i], 2 * c, 1e-12 * std::fabs(c) + 1e-15);
      EXPECT_EQ(same.core.window.quadric(v)[i], c);
    }
}

// Forty components in a budget of memory: rows are long, but as long as they are, not longer.
TEST(SeveralFields, OfManyComponentsKeepABudget) {
  TestMesh mesh = fullGrid(fieldsSide(), fieldsSide(), 2 * fieldsSide(), 0.1);
  for (int f = 0; f < 5; ++f)
    addPositionField(mesh, {textOf("f%d", f), 8, k32}, [f](double x, double y, double z) {
      return std::sin(0.3 * (f + 1) * x + 0.2 * y) + 0.02 * f * z * y;
    });
  SimplifyOptions options = toRatio(0.2);
  options.memory_bytes = 4 << 20;
  const Result result = simplified(mesh, options);
  expectSound(mesh, result);
  expectReached(result);
  EXPECT_LE(result.report.peak_window_bytes, size_t{4} << 20);
}

// Of one component of a field: its least and its largest value.
std::pair<double, double> rangeOf(const TestMesh& mesh, size_t field, int component) {
  std::pair<double, double> range = {HUGE_VAL, -HUGE_VAL};
  for (size_t v = 0; v < mesh.vertexCount(); ++v) {
    const double x = mesh.field(field, v, component);
    range = {std::min(range.first, x), std::max(range.second, x)};
  }
  return range;
}

// By how much of its range a component leaves it, at most.
double excess(const TestMesh& mesh, const TestMesh& result) {
  double most = 0;
  for (size_t f = 0; f < mesh.fields.size(); ++f)
    for (int i = 0; i < mesh.schema.fields[f].components; ++i) {
      const auto before = rangeOf(mesh, f, i), after = rangeOf(result, f, i);
      most = std::max({most, (before.first - after.first) / (before.second - before.first),
                       (after.second - before.second) / (before.second - before.first)});
    }
  return most;
}

// In every mode, and where cells are flipped.
void expectWithinRange(const TestMesh& mesh, SimplifyOptions options, const Cut& cut) {
  options.field_range = FieldRange::kKeep;
  for (const auto& [mode, shape] : {std::pair{Mode::kSweep, Shape::kField},
                                    {Mode::kSweep, Shape::kSolver},
                                    {Mode::kPaper, Shape::kField},
                                    {Mode::kQueue, Shape::kField}}) {
    options.mode = mode;
    options.shape = shape;
    const Result result = simplified(mesh, options, cut);
    expectSound(mesh, result);
    EXPECT_EQ(excess(mesh, result.out.mesh), 0);
  }
}

// Minimizers lie beyond it. Fields that are carried do not.
TEST(SeveralFields, StayWithinTheirRangeIfAsked) {
  for (ScalarType type : {k32, k64}) {
    const TestMesh mesh = fieldsMesh(type);
    for (int form = 0; form < 4; ++form) {
      if (slowRun() && (form % 3 == 0 || type == k32)) continue;
      SCOPED_TRACE(textOf("form %d", form));
      Cut cut;
      cut.say_box = form & 1;
      SimplifyOptions options = measuring({});
      if (form & 2) options.fields = {{"front", 1}};
      EXPECT_GT(excess(mesh, simplified(mesh, options, cut).out.mesh), 0.01);
      expectWithinRange(mesh, options, cut);
    }
  }
}

// Sheets of one layer of vertices: where few cells are left the best values are far from 0 and 1.
TEST(SeveralFields, LeaveTheirRangeByAQuarterAtMost) {
  TestMesh mesh = fullGrid(fieldsSide(), fieldsSide(), fieldsSide(), 0.3);
  addPositionField(mesh, {"sheets", 1, k64},
                   [](double x, double, double) { return std::lround(x) % 4 == 2 ? 1 : 0; });
  for (double ratio : {0.1, 0.03, 0.01})
    EXPECT_LE(excess(mesh, simplified(mesh, toRatio(ratio)).out.mesh), 0.25 + 1e-12);
}

// A field that reaches the largest numbers of its type, by a front or by what stands for no value.
TEST(SeveralFields, AreFiniteUpToTheLargestNumbers) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const int n = slowRun() ? 4 : fieldsSide();
  const auto steep = [n](double x, double y, double) {
    return 0.98 * static_cast<double>(kMost) * std::tanh(2 * (x + y - n));
  };
  const auto filled = [n](double x, double y, double) {
    return x + y > n + 1 ? static_cast<double>(kMost) : std::sin(x);
  };
  for (const auto& field : {std::function<double(double, double, double)>(steep), {filled}})
    for (ScalarType positions : {k32, k64})
      for (FieldRange range : {FieldRange::kFree, FieldRange::kKeep})
        for (Mode mode : {Mode::kSweep, Mode::kPaper}) {
          TestMesh mesh = fullGrid(n, n, n, 0.3, positions);
          addPositionField(mesh, {"f", 1, k32}, field);
          SimplifyOptions options = toRatio(0.2, 0, mode);
          options.field_range = range;
          const Result result = simplified(mesh, options);
          EXPECT_GT(result.report.collapses, 20);
          for (size_t v = 0; v < result.out.mesh.vertexCount(); ++v)
            EXPECT_TRUE(std::isfinite(result.out.mesh.field(0, v)));
        }
}

// A header that tells half of the range: values are as those they come from.
TEST(SeveralFields, AreNotPressedIntoARangeThatIsTooNarrow) {
  TestMesh mesh = fullGrid(fieldsSide(), fieldsSide(), fieldsSide(), 0.1);
  addPositionField(mesh, {"front", 1, k64}, front);
  mesh.schema.box_min = {0, 0, 0, -0.5};
  mesh.schema.box_max = {fieldsSide() + 0.0, fieldsSide() + 0.0, fieldsSide() + 0.0, 0.5};
  SimplifyOptions options = toRatio(0.3);
  options.field_range = FieldRange::kKeep;
  const Result result = simplified(mesh, options);
  const auto [least, most] = rangeOf(result.out.mesh, 0, 0);
  EXPECT_LT(least, -0.95);
  EXPECT_GT(most, 0.95);
}

// What lies outside of the box that a stream tells widens it: of a field of which it tells one
// number, too.
TEST(SeveralFields, AreFollowedWhateverBoxIsTold) {
  const double n = fieldsSide();
  TestMesh mesh = fullGrid(fieldsSide(), fieldsSide(), 2 * fieldsSide(), 0.1);
  addPositionField(mesh, {"front", 1, k64}, front);
  const auto error = [&mesh](double size, double least, double most) {
    mesh.schema.box_min = {0, 0, 0, least};
    mesh.schema.box_max = {size, size, 2 * size, most};
    return errorsOf(mesh, measuring({}))[0];
  };
  const double right = error(n, -1, 1);
  for (auto [least, most] : {std::pair{0.0, 0.0}, {0.0, 1e-30}, {-1e-6, 1e-6}})
    EXPECT_LT(error(n, least, most), 1.1 * right) << least << " to " << most;
  EXPECT_LT(error(1e-9 * n, -1, 1), 1.1 * right);
}

// A quarter of a thin tube, with waves along it and a layer of a twentieth of its inner radius.
TestMesh heatedTube() {
  const int n = fieldsSide();
  TestMesh mesh = fullGrid(2 * n, n, n, 0.1);
  for (size_t v = 0; v < mesh.vertexCount(); ++v) {
    const double angle = mesh.position(v, 0) / (2 * n) * std::acos(0.0);
    const double radius = 1 + std::pow(mesh.position(v, 1) / n, 2);
    mesh.setPosition(v, 0, radius * std::sin(angle));
    mesh.setPosition(v, 1, radius * std::cos(angle));
    mesh.setPosition(v, 2, 40 * mesh.position(v, 2) / n);
  }
  addPositionField(mesh, {"heat", 1, k64}, [](double x, double y, double z) {
    return std::exp(-20 * (std::sqrt(x * x + y * y) - 1)) +
           0.5 * std::sin(5 * x) * std::sin(0.5 * z);
  });
  return mesh;
}

// How far the middles of the faces at the tube's inside are from it, as root mean square.
double lossAtTheWall(const TestMesh& result) {
  std::map<std::array<int64_t, 3>, int> faces;
  for (size_t c = 0; c < result.cellCount(); ++c)
    for (size_t j = 0; j < 4; ++j) {
      std::array<int64_t, 3> face;
      for (size_t k = 0, out = 0; k < 4; ++k)
        if (k != j) face[out++] = result.cells[4 * c + k];
      std::sort(face.begin(), face.end());
      ++faces[face];
    }
  double sum = 0;
  int count = 0;
  for (const auto& [face, cells] : faces) {
    double x = 0, y = 0, outermost = 0;
    for (int64_t v : face) {
      const double a = result.position(static_cast<size_t>(v), 0),
                   b = result.position(static_cast<size_t>(v), 1);
      outermost = std::max(outermost, std::sqrt(a * a + b * b));
      x += a / 3;
      y += b / 3;
    }
    if (cells != 1 || outermost > 1.1) continue;
    sum += std::pow(std::sqrt(x * x + y * y) - 1, 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(AFieldThatIsSteepAtAWall, KeepsTheWall) {
  const TestMesh mesh = heatedTube();
  const Result result = simplified(mesh, toRatio(0.1));
  expectSound(mesh, result);
  expectReached(result);
  // With the boundary's own weight alone it is 0.026.
  EXPECT_LT(lossAtTheWall(result.out.mesh), 0.022);
}

TEST(SimplifierFields, AreRefusedWhereThereAreNone) {
  TestMesh mesh = fullGrid(2, 2, 4);
  addPositionField(mesh, {"f", 1, k64}, front);
  mesh.addIntegerField("label", [](size_t) { return int64_t{1}; });
  const auto refusal = [&](const char* name, double weight) {
    SimplifyOptions options;
    options.fields = {{name, weight}};
    return thrownBy([&] { simplified(mesh, options); });
  };
  EXPECT_EQ(refusal("f", 1).first, Status::kOk);
  EXPECT_EQ(refusal("g", 1).first, Status::kBadArgument);
  EXPECT_NE(refusal("g", 1).second.find("the stream has: f, label"), std::string::npos);
  EXPECT_EQ(refusal("label", 1).first, Status::kBadArgument);
  EXPECT_EQ(refusal("f", -1).first, Status::kBadArgument);
  EXPECT_EQ(refusal("f", std::numeric_limits<double>::quiet_NaN()).first, Status::kBadArgument);
}

}  // namespace
}  // namespace tetstream::test
