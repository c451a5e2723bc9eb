// Any number of threads gives what one gives, whatever a run is asked for.
#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <thread>

#include "faces.h"
#include "slow_run.h"
#include "strange_workers.h"
#include "tasks.h"
#include "ways_testing.h"

namespace tetstream::test {
namespace {

constexpr size_t kThreads[] = {3, 2, 4, 8};
constexpr int64_t kFewVertices = 48;  // to a tile: small meshes have many then

TestMesh withWaves(TestMesh mesh, ScalarType type) {
  addPositionField(mesh, {"f", 1, type},
                   [](double x, double y, double z) { return std::sin(x * y) - z; });
  return mesh;
}

TestMesh gridWithWaves(int n, ScalarType type) {
  return withWaves(fullGrid(n, n, n, 0.1), type);
}

// Of a field that is flat at one side, where tiles would take more than their shares of a goal.
TestMesh wavyAtOneSide(int n) {
  TestMesh mesh = fullGrid(n, n, n, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [n](double x, double y, double z) {
    return std::max(x - 0.4 * n, 0.0) * std::sin(y * z);
  });
  return mesh;
}

// With flat cells at one side, between two layers that lie on each other.
TestMesh flattenedGrid(int n) {
  const TestMesh grid = fullGrid(n, n, n);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) {
      const bool is_lowered = i == 2 && grid.position(v, 0) < 3 && grid.position(v, 2) == 2;
      positions.push_back(is_lowered ? 1 : grid.position(v, i));
    }
  return withWaves(makeMesh(ScalarType::kFloat64, positions, grid.cells), ScalarType::kFloat64);
}

struct Outcomes {
  Recorder out;
  Report report;
};

Outcomes ran(const TestMesh& mesh, SimplifyOptions options, const Tasks& tasks,
             const FaceLabels& faces = {}) {
  options.tasks = tasks.threads() > 1 ? &tasks : nullptr;
  options.tile_vertices = kFewVertices;
  Outcomes run;
  Simplifier simplifier(options, run.out, {});
  FacedStream stream(mesh, Cut{}, faces);
  copyStream(stream, simplifier);
  run.report = simplifier.report();
  EXPECT_EQ(run.out.problem, "");
  return run;
}

Outcomes ran(const TestMesh& mesh, const SimplifyOptions& options, size_t threads,
             const FaceLabels& faces = {}) {
  return ran(mesh, options, Tasks(threads), faces);
}

void expectSame(const TestMesh& mesh, const SimplifyOptions& options,
                const FaceLabels& faces = {}) {
  const Outcomes one = ran(mesh, options, 1, faces);
  EXPECT_GT(one.report.collapses, 0);
  for (size_t i = 0; i < std::size(kThreads); i += oneIn(4)) {
    const size_t threads = kThreads[i];
    SCOPED_TRACE(textOf("%zu threads", threads));
    const Outcomes many = ran(mesh, options, threads, faces);
    EXPECT_TRUE(many.out.allBytes() == one.out.allBytes());
    EXPECT_TRUE(many.out.faces == one.out.faces);
    EXPECT_EQ(many.report.collapses, one.report.collapses);
    EXPECT_EQ(many.report.flips, one.report.flips);
    EXPECT_EQ(many.report.rejected_orientation, one.report.rejected_orientation);
    EXPECT_EQ(many.report.rejected_other, one.report.rejected_other);
    EXPECT_EQ(many.report.largest_error, one.report.largest_error);
    EXPECT_EQ(std::bit_cast<uint64_t>(many.report.estimated_error),  // NaN without fields
              std::bit_cast<uint64_t>(one.report.estimated_error));
  }
}

int wavySide() {
  return slowRun() ? 6 : 10;
}

TEST(SweepThreads, GiveTheSameBytesForEachRatioAndWindow) {
  for (ScalarType type : {ScalarType::kFloat32, ScalarType::kFloat64})
    for (double ratio : {0.5, 0.1, 0.02})
      for (int64_t window : {0, 2500}) {
        SCOPED_TRACE(textOf("ratio %g, window %lld", ratio, static_cast<long long>(window)));
        expectSame(gridWithWaves(wavySide(), type), toRatio(ratio, window));
      }
}

TEST(SweepThreads, GiveTheSameBytesWhereCellsAreParked) {
  for (Shape shape : {Shape::kField, Shape::kSolver}) {
    SimplifyOptions options = parking(toRatio(0.1, 2500));
    options.shape = shape;
    expectSame(gridWithWaves(wavySide(), ScalarType::kFloat32), options);
  }
}

TEST(SweepThreads, GiveTheSameBytesUpToAnError) {
  SimplifyOptions options;
  options.error = 5;
  expectSame(gridWithWaves(wavySide(), ScalarType::kFloat64), options);
}

// At the smaller ratio tiles stop at their shares of what is left to the goal.
TEST(SweepThreads, GiveTheSameBytesWhereCellsAreFlipped) {
  for (double ratio : {0.2, 0.5}) {
    SimplifyOptions options = toRatio(ratio);
    options.shape = Shape::kSolver;
    const TestMesh mesh = gridWithWaves(wavySide(), ScalarType::kFloat64);
    EXPECT_GT(ran(mesh, options, 1).report.flips, 0);
    expectSame(mesh, options);
    expectSame(wavyAtOneSide(wavySide()), options);
  }
}

TEST(SweepThreads, GiveTheSameBytesWithHighEffort) {
  for (double ratio : {0.05, 0.3}) {
    SimplifyOptions options = toRatio(ratio);
    options.effort = Effort::kHigh;
    expectSame(wavyAtOneSide(wavySide()), options);
  }
}

// Of fewer cells than eight tiles, which are cut into slices while the goal is far.
TEST(SweepThreads, GiveTheSameBytesWhereTilesAreSlices) {
  for (double ratio : {0.05, 0.2}) {
    SimplifyOptions options = toRatio(ratio);
    options.shape = Shape::kSolver;
    for (int n : {4, 6}) expectSame(gridWithWaves(n, ScalarType::kFloat64), options);
  }
}

// Of stretched meshes, whose flips no tile waits for.
TEST(SweepThreads, GiveTheSameBytesWhereThinCellsAre) {
  const TestMesh grid = fullGrid(wavySide(), wavySide(), wavySide(), 0.2);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) positions.push_back(grid.position(v, i) / (i < 2 ? 1 : 12));
  const TestMesh mesh =
      withWaves(makeMesh(ScalarType::kFloat64, positions, grid.cells), ScalarType::kFloat64);
  EXPECT_GT(ran(mesh, toRatio(0.05), 1).report.flips, 0);
  for (int64_t window : {0, 2500}) expectSame(mesh, toRatio(0.05, window));
}

TEST(SweepThreads, GiveTheSameBytesWhereCellsAreFlat) {
  const TestMesh mesh = flattenedGrid(wavySide());
  EXPECT_GT(ran(mesh, toRatio(0.2), 1).report.locked_cells, 0);
  for (int64_t window : {0, 2500}) expectSame(mesh, toRatio(0.2, window));
}

TEST(SweepThreads, GiveTheSameBytesInOtherModes) {
  for (Mode mode : {Mode::kPaper, Mode::kQueue})
    expectSame(gridWithWaves(wavySide(), ScalarType::kFloat32), toRatio(0.2, 2500, mode));
}

TEST(SweepThreads, GiveTheSameBytesWhereDistancesAreMeasured) {
  SimplifyOptions options = toRatio(0.2, 2500);
  options.quadric = QuadricForm::kGarlandZhou;
  expectSame(gridWithWaves(wavySide(), ScalarType::kFloat64), options);
}

// They may refuse, work at once, or come late: nobody waits for what is not begun.
TEST(SweepThreads, GiveTheSameBytesWhateverTheWorkersThatWereBrought) {
  const TestMesh mesh = gridWithWaves(wavySide(), ScalarType::kFloat64);
  const Outcomes one = ran(mesh, toRatio(0.2, 2500), 1);
  NoWorkers none;
  HastyWorkers hasty;
  SwiftWorkers swift;
  LazyWorkers lazy;
  for (Workers* workers : std::initializer_list<Workers*>{&none, &hasty, &swift, &lazy}) {
    const Tasks tasks(3, workers);
    EXPECT_TRUE(ran(mesh, toRatio(0.2, 2500), tasks).out.allBytes() == one.out.allBytes());
  }
  lazy.workAll();
}

TEST(SweepThreads, GiveTheSameBytesWithWhatVerticesAndCellsCarry) {
  TestMesh mesh = gridWithWaves(wavySide(), ScalarType::kFloat64);
  mesh.addIntegerField("id", [](size_t v) { return static_cast<int64_t>(v); });
  mesh.addCellData({"density", 2, ScalarType::kFloat32},
                   [](size_t c, int k) { return std::sin(static_cast<double>(c) + k); });
  for (size_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked.push_back(v % 17 == 0);
  expectSame(mesh, toRatio(0.2));
}

TEST(SweepThreads, GiveTheSameBytesWithRegions) {
  TestMesh mesh = gridWithWaves(wavySide(), ScalarType::kFloat64);
  mesh.addIntegerCellData("material", [&](size_t c) {
    return mesh.position(static_cast<size_t>(mesh.cells[4 * c]), 2) < wavySide() / 2 ? 3 : 8;
  });
  expectSame(mesh, toRatio(0.2));
}

TEST(SweepThreads, GiveTheSameBytesWithLabelledFacesAndFeatures) {
  const int n[3] = {wavySide(), wavySide(), wavySide()};
  const TestMesh mesh = inStreamOrder(shakenInside(wavySide()));
  expectSame(mesh, toRatio(0.2), sidesOf(mesh, n));
  SimplifyOptions options = toRatio(0.2);
  options.feature_angle = 30;
  expectSame(mesh, options);
}

struct TracedIds final : MapSink, LogSink {
  void begin() override {}
  void begin(const Schema&) override {}
  void put(const MapRows& rows) override {
    ids.insert(ids.end(), rows.vertices, rows.vertices + rows.count);
    ids.insert(ids.end(), rows.cells, rows.cells + rows.count);
  }
  void put(const LogRows& rows) override {
    ids.insert(ids.end(), rows.kept, rows.kept + rows.count);
    ids.insert(ids.end(), rows.removed, rows.removed + rows.count);
  }
  void finish() override {}
  std::vector<int64_t> ids;
};

struct TracedRun {
  TracedIds rows;
  Recorder out;
};

std::unique_ptr<TracedRun> tracedBy(const TestMesh& mesh, SimplifyOptions options, size_t threads) {
  const Tasks tasks(threads);
  options.tasks = &tasks;
  options.tile_vertices = kFewVertices;
  auto run = std::make_unique<TracedRun>();
  Simplifier simplifier(options, run->out, {});
  simplifier.trace({&run->rows, &run->rows});
  MeshStream stream(mesh, Cut{});
  copyStream(stream, simplifier);
  return run;
}

TEST(SweepThreads, TellTheSameMapAndLog) {
  const TestMesh mesh = gridWithWaves(wavySide(), ScalarType::kFloat64);
  const auto one = tracedBy(mesh, toRatio(0.2), 1);
  EXPECT_GT(one->rows.ids.size(), mesh.vertexCount());
  EXPECT_TRUE(tracedBy(mesh, toRatio(0.2), 3)->rows.ids == one->rows.ids);
}

// Tiles stop at the shares at which they stop where nobody is told.
TEST(SweepThreads, GiveTheSameBytesWhereAMapAndALogAreTold) {
  for (int n : {6, wavySide()})
    for (double ratio : {0.1, 0.2}) {
      SCOPED_TRACE(textOf("%d cubes a side, ratio %g", n, ratio));
      const TestMesh mesh = wavyAtOneSide(n);
      SimplifyOptions options = toRatio(ratio);
      options.shape = Shape::kSolver;
      const auto one = tracedBy(mesh, options, 1);
      EXPECT_TRUE(one->out.allBytes() == ran(mesh, options, 2).out.allBytes());
      const auto many = tracedBy(mesh, options, 3);
      EXPECT_TRUE(many->rows.ids == one->rows.ids);
      EXPECT_TRUE(many->out.allBytes() == one->out.allBytes());
    }
}

// Callbacks come on the caller's thread; one that fails ends the run, and nobody waits for ever.
void expectToStopAtCalls(const Tasks& tasks) {
  const TestMesh mesh = gridWithWaves(wavySide(), ScalarType::kFloat64);
  const std::thread::id caller = std::this_thread::get_id();
  for (int last = 1; last < 6; ++last) {
    SimplifyOptions options = toRatio(0.1);
    options.tasks = &tasks;
    options.tile_vertices = kFewVertices;
    int told = 0;
    Recorder out;
    Simplifier simplifier(options, out, [&](const Progress&) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      if (++told == last) fail(Status::kCancelled, "enough");
    });
    MeshStream stream(mesh, Cut{});
    EXPECT_EQ(thrownBy([&] { copyStream(stream, simplifier); }).second, "enough");
  }
}

TEST(SweepThreads, StopWhenACallbackFails) {
  expectToStopAtCalls(Tasks(4));
}

// The caller is told as the run goes on, though it has no part in the work.
TEST(SweepThreads, StopWhenACallbackFailsWhereOthersDoAllTheWork) {
  SwiftWorkers swift;
  expectToStopAtCalls(Tasks(4, &swift));
}

// With a memory budget there is one patch at a time, and no more memory than one takes.
TEST(SweepThreads, TakeNoMemoryBeyondABudget) {
  const TestMesh mesh = gridWithWaves(wavySide(), ScalarType::kFloat64);
  SimplifyOptions options = toRatio(0.2);
  options.memory_bytes = 8 << 20;
  const Outcomes one = ran(mesh, options, 1), many = ran(mesh, options, 8);
  EXPECT_TRUE(many.out.allBytes() == one.out.allBytes());
  EXPECT_EQ(many.report.peak_window_bytes, one.report.peak_window_bytes);
}

}  // namespace
}  // namespace tetstream::test
