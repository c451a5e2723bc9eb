// A bound on the error is kept, as it is measured on the result and not only as the quadrics see
// it, and does not end a run long before; of several targets the first that is reached ends it.
#include <cmath>

#include "field_error.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

double waves(double x, double y, double z) {
  return std::sin(5 * x) * std::cos(4 * y) + 0.5 * std::sin(6 * z + x);
}

int boxSide() {
  return slowRun() ? 4 : 12;
}
// Larger cells, larger errors.
double coarse() {
  return slowRun() ? 12 : 1;
}

// A box of 1 x 1 x 2, swept along z: 20,736 cells, of which 864 are a front.
TestMesh boxOf(ScalarType type) {
  const int n = boxSide();
  const TestMesh grid = fullGrid(n, n, 2 * n, 0.1);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) positions.push_back(grid.position(v, i) / n);
  return makeMesh(type, positions, grid.cells);
}

TestMesh wavyMesh(ScalarType type) {
  TestMesh mesh = boxOf(type);
  addPositionField(mesh, {"f", 1, type},
                   [](double x, double y, double z) { return 300 + 40 * waves(x, y, z); });
  return mesh;
}

TestMesh withConstant(TestMesh mesh) {
  addPositionField(mesh, {"f", 1, k32}, [](double, double, double) { return 3; });
  return mesh;
}

int64_t fourFrontsOfBox() {
  return int64_t{24} * boxSide() * boxSide();
}

SimplifyOptions toError(double percent, int64_t window = 0) {
  SimplifyOptions options;
  options.error = percent;
  options.window_cells = window;
  return options;
}

// The length of the box of a field's values: of a vector the error's length is compared with it.
double rangeOf(const TestMesh& mesh, size_t field) {
  double sum = 0;
  for (int i = 0; i < mesh.schema.fields[field].components; ++i) {
    double low = mesh.field(field, 0, i), high = low;
    for (size_t v = 0; v < mesh.vertexCount(); ++v) {
      low = std::min(low, mesh.field(field, v, i));
      high = std::max(high, mesh.field(field, v, i));
    }
    sum += (high - low) * (high - low);
  }
  return std::sqrt(sum);
}

// RMS in percent of the range, all fields together.
double measured(const TestMesh& mesh, const Result& result) {
  const std::vector<double> errors = fieldErrors(mesh, result.out.mesh);
  double sum = 0;
  for (size_t f = 0; f < errors.size(); ++f) {
    const double share = errors[f] / rangeOf(mesh, f);
    sum += share * share;
  }
  return 100 * std::sqrt(sum);
}

// What holds for every run with a bound on the error: the two errors, and their order.
double expectWithin(const TestMesh& mesh, const Result& result, double percent) {
  EXPECT_EQ(result.out.problem, "");
  EXPECT_EQ(result.report.cells_out, static_cast<int64_t>(result.out.mesh.cellCount()));
  EXPECT_EQ(result.report.limited_by, "");
  const double error = measured(mesh, result);
  EXPECT_LE(error, percent);
  EXPECT_LE(result.report.estimated_error, percent);
  EXPECT_GE(result.report.estimated_error, error - 1e-9);
  return error;
}

// With a third of the cells the error would be larger than the one that was made.
void expectNotMuchTooEarly(const TestMesh& mesh, const Result& result, double error,
                           int64_t window) {
  const double third = static_cast<double>(result.report.cells_out) /
                       (3 * static_cast<double>(result.report.cells_in));
  const Result smaller = simplified(mesh, toRatio(third, window));
  EXPECT_GT(measured(mesh, smaller), error) << result.report.cells_out << " cells are left";
}

void expectErrorKept(const TestMesh& mesh, double percent, int64_t window, const Cut& cut = {}) {
  percent *= coarse();
  SCOPED_TRACE(textOf("at most %g %%, window %lld", percent, static_cast<long long>(window)));
  const Result result = simplified(mesh, toError(percent, window), cut);
  const double error = expectWithin(mesh, result, percent);
  EXPECT_EQ(result.report.reached, "error");
  EXPECT_LT(result.report.cells_out, result.report.cells_in);
  if (!slowRun()) expectNotMuchTooEarly(mesh, result, error, window);
}

TEST(SimplifierErrorBound, IsKeptByWhatIsMeasuredWithAllCellsInCore) {
  for (ScalarType type : {k32, k64}) {
    const TestMesh mesh = wavyMesh(type);
    for (double percent : {0.1, 1.0, 3.0}) expectErrorKept(mesh, percent, 0);
  }
}
TEST(SimplifierErrorBound, IsKeptByWhatIsMeasuredThroughSeveralWindows) {
  for (ScalarType type : {k32, k64}) {
    const TestMesh mesh = wavyMesh(type);
    for (double percent : {0.1, 1.0, 3.0}) expectErrorKept(mesh, percent, fourFrontsOfBox());
  }
}
TEST(SimplifierErrorBound, IsKeptThroughAWindowOfEightFronts) {
  for (double percent : {0.02, 0.5, 2.0})
    expectErrorKept(wavyMesh(k32), percent, 2 * fourFrontsOfBox());
}

// The ranges are known beforehand, or only as the stream comes; so is its length.
TEST(SimplifierErrorBound, IsKeptWhateverTheHeaderSays) {
  const TestMesh mesh = wavyMesh(k64);
  for (int form = 0; form < 4; ++form) {
    SCOPED_TRACE(form);
    Cut cut;
    cut.say_box = form & 1;
    cut.say_counts = form & 2;
    expectErrorKept(mesh, 1, fourFrontsOfBox(), cut);
  }
}

TEST(SimplifierErrorBound, HoldsForAllFieldsTogether) {
  TestMesh mesh = wavyMesh(k32);
  addPositionField(mesh, {"g", 1, k32}, [](double x, double y, double z) {
    return 1e-6 * std::cos(3 * x - y) * (1 + z);
  });
  addPositionField(mesh, {"v", 3, k32},
                   [](double x, double y, double z) { return 1e3 * std::sin(x + 2 * y + z); });
  for (int64_t window : {int64_t{0}, fourFrontsOfBox()}) expectErrorKept(mesh, 2, window);
}

// What is carried is not followed, and does not count.
TEST(SimplifierErrorBound, HoldsForMeasuredFieldsOnly) {
  TestMesh mesh = wavyMesh(k64);
  mesh.addField({"noise", 1, k64}, [](size_t v, int) { return static_cast<double>(v * 7 % 5); });
  SimplifyOptions options = toError(coarse());
  options.fields = {{"f", 1}};
  const Result result = simplified(mesh, options);
  EXPECT_EQ(result.report.reached, "error");
  EXPECT_LE(100 * fieldErrors(mesh, result.out.mesh)[0] / rangeOf(mesh, 0), coarse());
  EXPECT_EQ(result.report.cells_out, simplified(wavyMesh(k64), toError(coarse())).report.cells_out);
}

// Weights tell fields from each other: that of a single one changes nothing, and the heaviest has
// the error that is asked for.
TEST(SimplifierErrorBound, IsInUnitsOfTheHeaviestField) {
  TestMesh mesh = wavyMesh(k64);
  SimplifyOptions options = toError(coarse());
  const Result plain = simplified(mesh, options);
  for (double weight : {1e-30, 0.25, 1e30}) {
    options.fields = {{"f", weight}};
    const Result result = simplified(mesh, options);
    EXPECT_EQ(result.out.mesh.cells, plain.out.mesh.cells) << weight;
    EXPECT_EQ(result.report.estimated_error, plain.report.estimated_error) << weight;
  }
  addPositionField(mesh, {"g", 1, k64}, [](double x, double y, double z) {
    return std::cos(3 * x - y) * std::sin(9 * z);
  });
  options.fields = {{"f", 100}, {"g", 1}};
  const Result result = simplified(mesh, options);
  EXPECT_LE(100 * fieldErrors(mesh, result.out.mesh)[0] / rangeOf(mesh, 0), coarse());
  EXPECT_LE(100 * fieldErrors(mesh, result.out.mesh)[1] / rangeOf(mesh, 1), 10 * coarse());
  options.fields = {{"f", 1}, {"g", 0.01}};
  EXPECT_EQ(simplified(mesh, options).out.mesh.cells, result.out.mesh.cells);
}

TEST(SimplifierErrorBound, IsSpentOnFewerCellsTheLargerItIs) {
  const TestMesh mesh = wavyMesh(k32);
  for (int64_t window : {int64_t{0}, fourFrontsOfBox()}) {
    int64_t cells = static_cast<int64_t>(mesh.cellCount());
    for (double percent : {0.1 * coarse(), 0.5 * coarse(), 2 * coarse()}) {
      const Report report = simplified(mesh, toError(percent, window)).report;
      EXPECT_LT(report.cells_out, cells) << percent;
      EXPECT_GE(report.estimated_error, percent / 2);
      cells = report.cells_out;
    }
  }
}

// Quadrics tell twice the error that is made, and more; what is measured tells it.
TEST(SimplifierErrorBound, IsUsedUp) {
  const TestMesh mesh = wavyMesh(k32);
  for (const int64_t window : {int64_t{0}, 2 * fourFrontsOfBox()})
    for (const double percent : {coarse(), 2 * coarse()})
      EXPECT_GT(measured(mesh, simplified(mesh, toError(percent, window))),
                (slowRun() ? 0.6 : 0.72) * percent)
          << percent << " window " << window;
}

// Of bodies full of holes the boundary's part of what quadrics tell was many times the fields'.
TEST(EstimatedError, IsNearTheOneThatIsMade) {
  const auto isThere = [](int x, int y, int z) {
    return (x % 2 == 0) + (y % 2 == 0) + (z % 2 == 0) >= 2;
  };
  TestMesh sponge = cubes(15, 15, 3, isThere);
  addPositionField(sponge, {"f", 1, k64}, [](double x, double y, double z) {
    return std::sin(0.2 * x) + std::cos(0.15 * y) + 0.1 * z;
  });
  for (const TestMesh& mesh : {wavyMesh(k64), sponge})
    for (const int64_t window : {int64_t{0}, int64_t{3500}})
      for (const double ratio : {0.5, 0.25}) {
        const Result result = simplified(mesh, toRatio(ratio, window));
        const double error = measured(mesh, result);
        EXPECT_GE(result.report.estimated_error, 0.8 * error) << ratio << " window " << window;
        EXPECT_LE(result.report.estimated_error, 1.6 * error) << ratio << " window " << window;
      }
}

TEST(EstimatedError, IsNothingWhereNothingIsDone) {
  const TestMesh mesh = wavyMesh(k64);
  for (const int64_t window : {int64_t{0}, fourFrontsOfBox()})
    EXPECT_LT(simplified(mesh, toRatio(1, window)).report.estimated_error, 1e-9) << window;
}

// A long box with all of its detail in the middle.
TestMesh quietAtItsEnds() {
  const int n = slowRun() ? 4 : 10;
  TestMesh mesh = fullGrid(n, n, 8 * n, 0.1);
  addPositionField(mesh, {"f", 1, k32}, [n](double x, double y, double z) {
    const double far = (z / n - 4) / 0.6;
    return std::sin(9 * x / n) * std::cos(7 * y / n) * std::exp(-far * far);
  });
  return mesh;
}

// Windows of any size leave about as many cells as the whole mesh in one: neither the quiet ones
// before use up what is allowed, nor the first tiles of one. That left up to seven times as many.
TEST(SimplifierErrorBound, IsSpentAlikeThroughWindowsOfAnySize) {
  const TestMesh mesh = quietAtItsEnds();
  const auto all = static_cast<double>(mesh.cellCount());
  for (const double error : {0.5, 1.5, 3.0}) {
    if (slowRun() && error > 2) continue;
    const auto whole = static_cast<double>(simplified(mesh, toError(error)).report.cells_out);
    for (const double part : {0.1, 0.2, 0.3, 0.45, 0.6}) {
      if (slowRun() && (part == 0.2 || part == 0.45)) continue;
      const Result result = simplified(mesh, toError(error, static_cast<int64_t>(part * all)));
      EXPECT_LT(static_cast<double>(result.report.cells_out), (slowRun() ? 2 : 1.4) * whole)
          << part << " " << error;
      EXPECT_LE(result.report.estimated_error, error);
    }
  }
}

// Whoever bounds the error has missed no number of cells, whatever stops the run.
TEST(SimplifierErrorBound, AloneIsNeverMissed) {
  std::vector<TestMesh> meshes = {wavyMesh(k64), withConstant(boxOf(k32)), withConstant(oneCell()),
                                  withConstant(apart(2))};
  for (TestMesh& mesh : meshes)
    for (double percent : {1e-9, 1.0, 100.0})
      for (int64_t window : {0, 600}) {
        SCOPED_TRACE(textOf("%zu cells, %g %%", mesh.cellCount(), percent));
        const Result result = simplified(mesh, toError(percent, window));
        EXPECT_EQ(result.out.problem, "");
        EXPECT_EQ(result.report.limited_by, "");
        EXPECT_EQ(result.report.target_cells, 0);
        EXPECT_TRUE(result.report.reached == "error" || result.report.reached.empty());
        EXPECT_LE(result.report.estimated_error, percent);
      }
}

// Of shapes and the boundary alone there is no range that it could be a share of.
TEST(SimplifierErrorBound, IsRefusedWhereNoFieldIsMeasured) {
  SimplifyOptions options = toError(1);
  const auto refusal = [&options](const TestMesh& mesh) {
    return thrownBy([&] { simplified(mesh, options); });
  };
  const auto [status, text] = refusal(boxOf(k64));
  EXPECT_EQ(status, Status::kBadArgument);
  EXPECT_NE(text.find("no field is measured; the stream has: none"), std::string::npos) << text;
  options.fields = {{"f", 0}};
  EXPECT_NE(refusal(wavyMesh(k64)).second.find("the stream has: f"), std::string::npos);
  options.error = 0;
  options.ratio = 0.5;
  EXPECT_TRUE(std::isnan(simplified(wavyMesh(k64), options).report.estimated_error));
}

// ------------------------------------------------------------------------- several targets

// Every target that was asked for is kept, and the one that left the most cells is named.
Result expectReachedFirst(const TestMesh& mesh, SimplifyOptions options, const std::string& name) {
  const Result result = simplified(mesh, options);
  const Report& report = result.report;
  EXPECT_EQ(result.out.problem, "");
  EXPECT_EQ(report.reached, name);
  EXPECT_EQ(report.limited_by, "");
  const double ratio = options.ratio * static_cast<double>(report.cells_in);
  const double slack = static_cast<double>(std::max<int64_t>(report.target_cells / 500, 10));
  EXPECT_GE(static_cast<double>(report.cells_out), ratio - slack);
  EXPECT_GE(static_cast<double>(report.cells_out), static_cast<double>(options.cells) - slack);
  if (options.error > 0) {
    EXPECT_LE(report.estimated_error, options.error);
    EXPECT_LE(measured(mesh, result), options.error);
  }
  if (name != "error") expectReached(result);
  return result;
}

TEST(SimplifierTargets, RatioAndCellsEndAtTheLargerCount) {
  const TestMesh mesh = wavyMesh(k32);
  const auto half = static_cast<int64_t>(mesh.cellCount() / 2);
  for (Mode mode : kModes)
    for (int64_t window : {int64_t{0}, fourFrontsOfBox()}) {
      SimplifyOptions options = toRatio(0.2, window, mode);
      options.cells = half;
      const Result more = expectReachedFirst(mesh, options, "cells");
      EXPECT_EQ(more.report.target_cells, half);
      options.ratio = 0.7;
      const Result less = expectReachedFirst(mesh, options, "ratio");
      EXPECT_EQ(less.report.target_cells,
                static_cast<int64_t>(0.7 * static_cast<double>(mesh.cellCount())));
    }
}

TEST(SimplifierTargets, RatioAndErrorEndAtTheFirst) {
  const TestMesh mesh = wavyMesh(k32);
  for (int64_t window : {int64_t{0}, fourFrontsOfBox()}) {
    SCOPED_TRACE(window);
    SimplifyOptions options = toRatio(0.02, window);
    options.error = 0.3 * coarse();
    expectReachedFirst(mesh, options, "error");
    options.ratio = 0.6;
    options.error = 60;
    expectReachedFirst(mesh, options, "ratio");
  }
}

TEST(SimplifierTargets, CellsAndErrorEndAtTheFirst) {
  const TestMesh mesh = wavyMesh(k64);
  for (int64_t window : {int64_t{0}, fourFrontsOfBox()}) {
    SCOPED_TRACE(window);
    SimplifyOptions options = toError(0.3 * coarse(), window);
    options.cells = 50;
    expectReachedFirst(mesh, options, "error");
    options.cells = static_cast<int64_t>(mesh.cellCount() / 2);
    options.error = 60;
    expectReachedFirst(mesh, options, "cells");
  }
}

TEST(SimplifierTargets, AllThreeEndAtTheFirst) {
  const TestMesh mesh = wavyMesh(k32);
  SimplifyOptions options = toRatio(0.05, fourFrontsOfBox());
  options.cells = static_cast<int64_t>(mesh.cellCount() / 10);
  options.error = 0.3 * coarse();
  expectReachedFirst(mesh, options, "error");
  options.error = 60;
  expectReachedFirst(mesh, options, "cells");
  options.ratio = 0.5;
  expectReachedFirst(mesh, options, "ratio");
}

// A bound that is far away must not cost accuracy.
TEST(SimplifierTargets, AFarBoundOnTheErrorLeavesTheErrorOfTheRatio) {
  if (slowRun()) return;
  const TestMesh mesh = wavyMesh(k32);
  for (int64_t window : {int64_t{0}, fourFrontsOfBox()}) {
    SimplifyOptions options = toRatio(0.2, window);
    const double alone = measured(mesh, simplified(mesh, options));
    options.error = 50;
    EXPECT_LE(measured(mesh, simplified(mesh, options)), 1.25 * alone) << "window " << window;
  }
}

// What the boundary counts is chosen for what is left where the error ends the run, not for so few.
TEST(SimplifierTargets, AFarRatioLeavesTheCellsOfTheError) {
  const TestMesh mesh = roughSlab(slowRun() ? 12 : 20, 0.2, 6);
  const Result alone = simplified(mesh, toError(1));
  SimplifyOptions both = toError(1);
  both.ratio = 0.005;
  EXPECT_EQ(alone.report.reached, "error");
  EXPECT_LT(simplified(mesh, both).report.cells_out, 1.1 * double(alone.report.cells_out));
}

// Though the last window, of which nothing may be moved, was not stopped by it.
TEST(SimplifierTargets, TheBoundThatStoppedTheWindowsIsNamed) {
  TestMesh mesh = fullGrid(6, 6, 40);
  addPositionField(mesh, {"wave", 1, k64}, [](double x, double y, double z) {
    return std::sin(2 * z) * std::cos(2 * x + y);
  });
  mesh.locked.resize(mesh.vertexCount());
  for (size_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked[v] = mesh.position(v, 2) > 24;
  SimplifyOptions options = toRatio(0.02, 2500);
  options.error = 0.5;
  const Result result = simplified(mesh, options);
  EXPECT_EQ(result.report.reached, "error");
  EXPECT_EQ(result.report.limited_by, "");
}

TEST(SimplifierTargets, NoneMeansATenth) {
  const TestMesh mesh = wavyMesh(k32);
  for (Mode mode : kModes) {
    const Result result = simplified(mesh, inMode(mode));
    expectReached(result);
    EXPECT_EQ(result.report.target_cells, static_cast<int64_t>(mesh.cellCount() / 10));
    EXPECT_EQ(result.report.reached, "ratio");
    EXPECT_TRUE(result.out.allBytes() == simplified(mesh, toRatio(0.1, 0, mode)).out.allBytes());
  }
}

TEST(SimplifierTargets, OfCellsNeedACountWhateverElseIsAskedFor) {
  const TestMesh mesh = wavyMesh(k32);
  Cut cut;
  cut.say_counts = false;
  SimplifyOptions options = toRatio(0.5);
  options.cells = 100;
  options.error = 1;
  const auto [status, text] = thrownBy([&] { simplified(mesh, options, cut); });
  EXPECT_EQ(status, Status::kUnsupported);
  EXPECT_NE(text.find("does not say how many"), std::string::npos) << text;
}

TEST(SimplifierTargets, OfTheErrorAreForTheSweepOnly) {
  for (auto [mode, name] : {std::pair(Mode::kPaper, "paper"), std::pair(Mode::kQueue, "queue")}) {
    SimplifyOptions options = toRatio(0.5, 0, mode);
    options.error = 1;
    const TestMesh mesh = withConstant(oneCell());
    const auto [status, text] = thrownBy([&] { simplified(mesh, options); });
    EXPECT_EQ(status, Status::kUnsupported);
    EXPECT_NE(text.find(name), std::string::npos) << text;
  }
}

// Distances to hyperplanes are no errors of fields: none is told of them.
TEST(SimplifierTargets, OfTheErrorAreNotForGarlandZhou) {
  const TestMesh mesh = wavyMesh(k32);
  SimplifyOptions options = toRatio(0.5);
  options.quadric = QuadricForm::kGarlandZhou;
  EXPECT_TRUE(std::isnan(simplified(mesh, options).report.estimated_error));
  options.error = 1;
  const auto [status, text] = thrownBy([&] { simplified(mesh, options); });
  EXPECT_EQ(status, Status::kUnsupported);
  EXPECT_NE(text.find("garland-zhou"), std::string::npos) << text;
}

}  // namespace
}  // namespace tetstream::test
