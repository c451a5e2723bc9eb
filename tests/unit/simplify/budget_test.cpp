// How many cells come out, what stops a run short, what memory it takes, how it is cancelled.
#include <cmath>

#include "budget.h"
#include "mix.h"
#include "simplifier.h"
#include "simplify_testing.h"
#include "tasks.h"
#include "window_size.h"

namespace tetstream::test {
namespace {

using Value = std::function<double(double, double, double)>;

TestMesh gridWith(int n, const Value& value, ScalarType type = ScalarType::kFloat64) {
  TestMesh mesh = fullGrid(n, n, 2 * n, 0.05, type);
  addPositionField(mesh, {"f", 1, type}, value);
  return mesh;
}

void expectAllRatiosReached(const TestMesh& mesh) {
  for (Mode mode : kModes)
    for (double ratio : {0.5, 0.1, 0.02})
      for (int64_t window : {2000, 0}) {  // 2000 cells: about four fronts
        if (slowRun() && (window == 0 || ratio == 0.5)) continue;
        SCOPED_TRACE(textOf("mode %d, ratio %g, window %lld", static_cast<int>(mode), ratio,
                            static_cast<long long>(window)));
        const Result result = simplified(mesh, toRatio(ratio, window, mode));
        expectSound(mesh, result);
        expectReached(result);
      }
}

int gridSide() {
  return slowRun() ? 4 : 8;
}

// Fields that make every position equally good must not lock a run.
TEST(SimplifierTarget, IsReachedForAZeroField) {
  expectAllRatiosReached(gridWith(gridSide(), [](double, double, double) { return 0.0; }));
}
TEST(SimplifierTarget, IsReachedForAConstantField) {
  expectAllRatiosReached(gridWith(
      gridSide(), [](double, double, double) { return 1e9; }, ScalarType::kFloat32));
}
TEST(SimplifierTarget, IsReachedForALinearField) {
  expectAllRatiosReached(
      gridWith(gridSide(), [](double x, double y, double z) { return x - y + 2 * z; }));
}
TEST(SimplifierTarget, IsReachedForAHalfFlatField) {
  expectAllRatiosReached(
      gridWith(gridSide(), [](double, double, double z) { return z < 4 ? 0 : std::sin(z); }));
}
TEST(SimplifierTarget, IsReachedForAStep) {
  expectAllRatiosReached(
      gridWith(gridSide(), [](double, double, double z) { return z < 4.2 ? 0 : 1e6; }));
}
// 1 / range is no float32 any more: the field counts as constant.
TEST(SimplifierTarget, IsReachedForARangeThatCannotBeDividedBy) {
  expectAllRatiosReached(gridWith(
      gridSide(), [](double x, double, double) { return 1e-41 * x; }, ScalarType::kFloat32));
}

TEST(SimplifierTarget, OfAMeshWithoutCellsIsItsRatio) {
  Recorder out;
  Simplifier simplifier(toRatio(0.5), out, {});
  simplifier.begin(Schema{});
  simplifier.finish();
  EXPECT_EQ(simplifier.report().reached, "ratio");
}

// Layers that shrink to 1e-9 of the first: float32 errors underflow, and the bound that rises from
// window to window must not stand still at nothing.
TEST(SimplifierTarget, IsReachedWhereErrorsUnderflow) {
  const TestMesh grid = fullGrid(4, 4, slowRun() ? 40 : 80);
  std::vector<double> points;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    const double size = std::pow(1.3, -grid.position(v, 2));
    for (int axis = 0; axis < 2; ++axis)
      points.push_back(0.3 * size * (grid.position(v, axis) - 2));
    points.push_back(-size);
  }
  const TestMesh mesh = makeMesh(ScalarType::kFloat32, points, grid.cells);
  for (Mode mode : kModes) expectSound(mesh, simplified(mesh, toRatio(0.5, 100, mode)));
}
TEST(SimplifierTarget, IsReachedWithoutAField) {
  expectAllRatiosReached(fullGrid(gridSide(), gridSide(), 2 * gridSide(), 0.05));
  expectAllRatiosReached(fullGrid(gridSide(), gridSide(), 2 * gridSide(), 0, ScalarType::kFloat32));
}
TEST(SimplifierTarget, IsReachedForGarlandZhou) {
  const TestMesh mesh = gridWith(gridSide(), [](double x, double y, double) { return x * y; });
  for (Mode mode : kModes) {
    SimplifyOptions options = toRatio(0.1, 0, mode);
    options.quadric = QuadricForm::kGarlandZhou;
    expectReached(simplified(mesh, options));
  }
}

TEST(SimplifierTarget, IsTheNumberOfCellsAskedFor) {
  const TestMesh mesh =
      gridWith(gridSide(), [](double x, double y, double z) { return x * y + z; });
  for (Mode mode : kModes)
    for (int64_t cells : {int64_t{100}, int64_t{333}, int64_t{2000}, int64_t{1} << 40})
      for (int64_t window : {2000, 0}) {
        SimplifyOptions options = toRatio(0, window, mode);
        options.cells = cells;
        const Result result = simplified(mesh, options);
        expectSound(mesh, result);
        EXPECT_EQ(result.report.target_cells,
                  std::min(cells, static_cast<int64_t>(mesh.cellCount())));
        expectReached(result);
      }
}

// No product of a decimal ratio is short of its whole number by rounding; of others the cell that
// they are short of is not made.
TEST(SimplifierTarget, OfARatioIsItsWholeNumberOfCells) {
  for (int64_t cells : {int64_t{100}, int64_t{1000}, int64_t{187300}, int64_t{14000000000}})
    for (int64_t percent = 1; percent <= 100; ++percent)
      EXPECT_EQ((Target{static_cast<double>(percent) / 100, 0, 0}).cellsOf(cells),
                cells / 100 * percent);
  EXPECT_EQ((Target{0.1, 0, 0}).cellsOf(187395), 18739);
  EXPECT_EQ((Target{1, 0, 0}).cellsOf(int64_t{1} << 48), int64_t{1} << 48);
  EXPECT_EQ((Target{0.29 * (1 - 1e-14), 0, 0}).cellsOf(100), 28);
}

TEST(SimplifierTarget, AsANumberOfCellsNeedsACountedStream) {
  const TestMesh mesh = oneCell();
  SimplifyOptions options;
  options.cells = 10;
  Cut cut;
  cut.say_counts = false;
  const auto [status, text] = thrownBy([&] { simplified(mesh, options, cut); });
  EXPECT_EQ(status, Status::kUnsupported);
  EXPECT_NE(text.find("ratio"), std::string::npos);
}

// All vertices locked: nothing can be done, and the report says so.
TEST(SimplifierTarget, IsMissedWithAReasonWhenEverythingIsLocked) {
  TestMesh mesh = gridWith(4, [](double x, double, double) { return x; });
  mesh.locked.assign(mesh.vertexCount(), 1);
  for (Mode mode : kModes) {
    const Result result = simplified(mesh, toRatio(0.1, 0, mode));
    expectSound(mesh, result);
    EXPECT_EQ(result.report.collapses, 0);
    EXPECT_NE(result.report.limited_by, "");
    EXPECT_EQ(result.out.allBytes(), simplified(mesh, toRatio(1)).out.allBytes());
  }
}

// 500 cubes that do not touch, of 6 cells each: none can lose its last cells.
TEST(SimplifierTarget, IsMissedWithAReasonForManySmallParts) {
  const TestMesh mesh =
      cubes(9, 9, 9, [](int x, int y, int z) { return x % 2 + y % 2 + z % 2 == 0; });
  const Result result = simplified(mesh, toRatio(0.02));
  expectSound(mesh, result);
  EXPECT_GE(result.report.cells_out, 125);
  EXPECT_NE(result.report.limited_by.find("topology"), std::string::npos)
      << result.report.limited_by;
}

TEST(SimplifierTarget, OfOneIsACopy) {
  const TestMesh mesh = gridWith(3, [](double x, double y, double z) { return x * y * z; });
  for (Mode mode : kModes) {
    const Result result = simplified(mesh, toRatio(1, 0, mode));
    EXPECT_TRUE(result.out.mesh.positions.bytes == mesh.positions.bytes);
    EXPECT_TRUE(result.out.mesh.cells == mesh.cells);
    EXPECT_TRUE(result.out.mesh.fields[0].bytes == mesh.fields[0].bytes);
    // A small window changes the order of what leaves, and nothing else.
    const Result small = simplified(mesh, toRatio(1, 64, mode));
    EXPECT_EQ(small.out.mesh.cellCount(), mesh.cellCount());
    EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(small.out.mesh)), "");
    EXPECT_EQ(factsOf(mesh).boundary_faces, factsOf(small.out.mesh).boundary_faces);
  }
}

TEST(SimplifierWindow, StaysAsSmallAsAskedForWhereTheFrontAllows) {
  const TestMesh mesh = fullGrid(4, 4, slowRun() ? 8 : 30);  // a front of about 100 cells
  for (Mode mode : kModes) {
    const Result result = simplified(mesh, toRatio(0.2, 500, mode));
    EXPECT_EQ(result.report.window_cells, 500);
    expectReached(result);
  }
}

TEST(SimplifierWindow, GrowsWhereTheFrontIsWider) {
  const TestMesh mesh = fullGrid(6, 6, 6);  // a front of more than 200 cells
  for (Mode mode : kModes) {
    const Result result = simplified(mesh, toRatio(0.2, 64, mode));
    EXPECT_GT(result.report.window_cells, 200);
    expectReached(result);
  }
}

// What came of a run with a memory budget; or why nothing did.
struct BudgetRun {
  Status status;
  std::string text, problem;
  Report report;
  std::vector<int64_t> cells;
};
BudgetRun simplifiedWithin(const TestMesh& mesh, SimplifyOptions options, int64_t bytes,
                           const Cut& cut = {}) {
  options.memory_bytes = bytes;
  Recorder out;
  Simplifier simplifier(options, out, {});
  MeshStream stream(mesh, cut);
  const auto [status, text] = thrownBy([&] { copyStream(stream, simplifier); });
  return {status, text, out.problem, simplifier.report(), out.mesh.cells};
}

// The budget that the sentence says should do; 0: none.
int64_t budgetToldBy(const std::string& text) {
  const size_t end = text.rfind(" should do");
  if (end == std::string::npos) return 0;
  return std::atoll(text.c_str() + text.rfind(' ', end - 1));
}

// A budget either holds or the run says that it is too small; it is never passed.
void expectWithinBudget(const TestMesh& mesh, Mode mode) {
  const int64_t needed =
      static_cast<int64_t>(simplified(mesh, toRatio(0.2, 0, mode)).report.peak_window_bytes);
  ASSERT_GT(needed, 100000);
  int held = 0, refused = 0;
  for (int64_t limit = 1000; limit < 2 * needed; limit += limit / (slowRun() ? 1 : 4)) {
    const BudgetRun run = simplifiedWithin(mesh, toRatio(0.2, limit % 2 ? 0 : 300, mode), limit);
    if (run.status == Status::kOk) {
      ++held;
      EXPECT_LE(run.report.peak_window_bytes, static_cast<uint64_t>(limit));
      EXPECT_EQ(run.problem, "");
    } else {
      ++refused;
      EXPECT_EQ(run.status, Status::kNoMemory);
      EXPECT_NE(run.text, "");
    }
  }
  EXPECT_GT(held, 0);
  EXPECT_GT(refused, 5);
}
TEST(SimplifierMemory, StaysWithinItsBudgetOrSaysThatItCannot) {
  TestMesh mesh = gridWith(6, [](double x, double y, double z) { return x * y + z; });
  mesh.addIntegerCellData("id", [](size_t c) { return static_cast<int64_t>(c); });
  for (Mode mode : kModes) expectWithinBudget(mesh, mode);
}

// Of a budget that is a multiple of what a run takes nothing is to be seen but its limit, whatever
// the number of threads; no smaller one does harm.
TEST(SimplifierMemory, IsNotMissedWhereThereIsMuchMore) {
  const TestMesh mesh = gridWith(slowRun() ? 8 : 14, [](double x, double y, double z) {
    return std::tanh(x + y - z - 6) + 0.01 * z;
  });
  const Result free = simplified(mesh, toRatio(0.05));
  const Tasks tasks(5);
  bool was_bound = false;
  for (const int64_t megabytes : {4, 16, 32, 48, 64, 256, 4096}) {
    SimplifyOptions options = toRatio(0.05);
    options.memory_bytes = megabytes << 20;
    const Result within = simplified(mesh, options);
    expectReached(within);
    EXPECT_LE(within.report.peak_window_bytes, static_cast<uint64_t>(options.memory_bytes));
    const bool is_bound = within.out.allBytes() != free.out.allBytes();
    was_bound |= is_bound;
    if (megabytes >= 64) {
      EXPECT_FALSE(is_bound) << megabytes;
    }
    options.tasks = &tasks;
    EXPECT_TRUE(simplified(mesh, options).out.allBytes() == within.out.allBytes()) << megabytes;
  }
  EXPECT_TRUE(was_bound);
}

// One for a stream whose length nobody knows is planned for, as in the paper's modes.
TEST(SimplifierMemory, IsALimitAloneWhereAllThatIsNeededIsKnown) {
  const TestMesh mesh = gridWith(6, [](double x, double y, double z) { return x * y + z; });
  Schema schema = mesh.schema;
  const auto isPlannedFor = [&](const SimplifyOptions& options) {
    const SimplifyOptions planned = Simplifier::planned(schema, options);
    EXPECT_EQ(planned.memory_bytes + planned.limit_bytes, options.memory_bytes);
    return planned.memory_bytes > 0;
  };
  SimplifyOptions options = toRatio(0.2);
  options.memory_bytes = int64_t{1} << 30;
  schema.cell_count = -1;
  EXPECT_TRUE(isPlannedFor(options));
  schema.cell_count = static_cast<int64_t>(mesh.cellCount());
  EXPECT_FALSE(isPlannedFor(options));
  schema.vertex_count = schema.cell_count;  // cells far apart
  EXPECT_TRUE(isPlannedFor(options));
  schema.vertex_count = static_cast<int64_t>(mesh.vertexCount());
  schema.cell_count = int64_t{1} << 60;  // says it, and of no front
  EXPECT_TRUE(isPlannedFor(options));
  schema.front_cells = int64_t{1} << 59;
  EXPECT_TRUE(isPlannedFor(options));
  schema.cell_count = static_cast<int64_t>(mesh.cellCount());
  options.mode = Mode::kPaper;
  EXPECT_TRUE(isPlannedFor(options));
}

// Also where not even the first arrays fit.
TEST(SimplifierMemory, IsSaidToSufficeWhereItDoes) {
  const TestMesh mesh = gridWith(10, [](double x, double y, double z) { return x * y + z; });
  Cut cut;
  cut.say_front = true;
  for (Mode mode : kModes)
    for (const int64_t limit : {10, 5000, 100000}) {
      const BudgetRun small = simplifiedWithin(mesh, toRatio(0.2, 0, mode), limit, cut);
      EXPECT_EQ(small.status, Status::kNoMemory);
      const int64_t enough = budgetToldBy(small.text);
      EXPECT_GT(enough, limit) << small.text;
      EXPECT_EQ(simplifiedWithin(mesh, toRatio(0.2, 0, mode), enough, cut).status, Status::kOk);
    }
}

// A window leaves little room beside its own vertices.
TEST(SimplifierMemory, IsSaidToSufficeWhereVerticesComeFirst) {
  const TestMesh mesh =
      gridWith(slowRun() ? 10 : 16, [](double x, double y, double z) { return x * y + z; });
  Cut cut;
  cut.all_vertices_first = true;
  for (const int64_t limit : {slowRun() ? 450000 : 600000, slowRun() ? 500000 : 900000}) {
    const BudgetRun small = simplifiedWithin(mesh, toRatio(0.2), limit, cut);
    EXPECT_EQ(small.status, Status::kNoMemory);
    const BudgetRun enough = simplifiedWithin(mesh, toRatio(0.2), budgetToldBy(small.text), cut);
    EXPECT_EQ(enough.status, Status::kOk) << small.text << "; " << enough.text;
  }
}

TEST(WindowSize, IsNoMoreThanCanBeNumbered) {
  const Schema schema;
  const SimplifyOptions options;
  EXPECT_EQ(WindowSize(schema, options, 100, 100).forFront(1 << 28),
            static_cast<int64_t>(Topology::kMost));
}

// Before the first window is full nobody may know the front: then the message tells of none.
TEST(SimplifierMemory, IsAskedForWithoutAFrontThatIsNotKnown) {
  const TestMesh mesh = gridWith(10, [](double x, double y, double z) { return x * y + z; });
  int refused = 0;
  for (Mode mode : kModes)
    for (bool say_counts : {false, true})
      for (int64_t limit = 20000; limit < 400000; limit += limit / (slowRun() ? 3 : 8)) {
        Cut cut;
        cut.say_counts = say_counts;
        const BudgetRun run = simplifiedWithin(mesh, toRatio(0.2, 0, mode), limit, cut);
        if (run.status != Status::kNoMemory) continue;
        refused += run.text.find(" should do") != std::string::npos;
        EXPECT_EQ(run.text.find("front of 0"), std::string::npos) << run.text;
      }
  EXPECT_GT(refused, 5);
}

// A window that starts small and grows must not fail with more memory where it held with less.
void expectMoreSuffices(const TestMesh& mesh, Mode mode) {
  Cut cut;
  cut.say_counts = false;
  int64_t sufficed = 0;
  for (int64_t limit = 300000; limit < 6000000; limit += limit / (slowRun() ? 2 : 12)) {
    const BudgetRun run = simplifiedWithin(mesh, toRatio(0.2, 0, mode), limit, cut);
    if (run.status == Status::kOk && sufficed == 0) sufficed = limit;
    if (sufficed > 0) {
      EXPECT_EQ(run.status, Status::kOk) << "mode " << static_cast<int>(mode) << ": " << limit
                                         << " fails, " << sufficed << " sufficed: " << run.text;
    }
  }
  EXPECT_GT(sufficed, 0);
}
TEST(SimplifierMemory, SufficesIfLessDid) {
  const TestMesh mesh = gridWith(slowRun() ? 6 : 14,
                                 [](double x, double y, double z) { return std::sin(x) + y * z; });
  for (Mode mode : kModes) expectMoreSuffices(mesh, mode);
}

// Of a wall, whose patches have several times as many faces as those of a body: where they do not
// fit smaller ones do.
TEST(SimplifierMemory, SufficesForTheSmallerPatchesOfAWall) {
  const int32_t size = slowRun() ? 40 : 80;
  TestMesh mesh = fullGrid(size, size, 1);
  addPositionField(mesh, {"f", 3, ScalarType::kFloat32},
                   [](double x, double y, double) { return std::sin(x / 5) * std::cos(y / 7); });
  SimplifyOptions options = toRatio(0.1, 0);
  for (options.memory_bytes = 700000; options.memory_bytes < 1500000;
       options.memory_bytes += slowRun() ? 250000 : 50000) {
    SCOPED_TRACE(options.memory_bytes);
    const Result result = simplified(mesh, options);
    expectSound(mesh, result);
    expectReached(result);
    EXPECT_NEAR(result.report.volume_out, result.report.volume_in, 1e-6 * result.report.volume_in);
    EXPECT_LE(result.report.peak_window_bytes, static_cast<uint64_t>(options.memory_bytes));
  }
}

// A sponge of two materials, nearly all of whose vertices are on curves.
TEST(SimplifierMemory, SufficesIfLessDidWhereCurvesAreMany) {
  const int n = slowRun() ? 6 : 14;
  const TestMesh grid = gridWith(n, [](double x, double y, double z) { return x + 2 * y + 3 * z; });
  std::vector<int64_t> cells;
  for (size_t c = 0; c < grid.cellCount(); ++c)
    if (mix(c + 1) % 10) cells.insert(cells.end(), &grid.cells[4 * c], &grid.cells[4 * c] + 4);
  TestMesh sponge = grid;
  sponge.cells = cells;
  sponge.addIntegerCellData("material", [&](size_t c) {
    return grid.position(static_cast<size_t>(cells[4 * c]), 0) > n / 2.0;
  });
  expectMoreSuffices(inStreamOrder(sponge), Mode::kSweep);
}

// As thin as a wall, with three cells to a vertex: a window has its vertices before its cells.
BudgetRun simplifiedWall(const TestMesh& wall, Mode mode, int64_t window, int64_t bytes,
                         size_t batch_cells) {
  Cut cut;
  cut.batch_cells = batch_cells;
  return simplifiedWithin(wall, toRatio(0.2, window, mode), bytes, cut);
}

// What is said to do does, and how the stream is cut makes no difference. Returns how often it was
// said.
int expectWallFits(const TestMesh& wall, Mode mode, int64_t window) {
  int held = 0, told = 0;
  const int64_t least = window > 0 ? 600000 : 300000;  // for the arrays that come before all else
  for (int64_t limit = least; limit < 3000000; limit += limit / (slowRun() ? 1 : 8)) {
    const BudgetRun run = simplifiedWall(wall, mode, window, limit, 4096);
    const BudgetRun finer = simplifiedWall(wall, mode, window, limit, 64);
    EXPECT_EQ(finer.status, run.status) << limit << ": " << run.text << finer.text;
    if (run.status == Status::kOk) {
      EXPECT_TRUE(finer.cells == run.cells) << limit;
      ++held;
      continue;
    }
    EXPECT_EQ(held, 0) << limit << ": " << run.text;
    const int64_t enough = budgetToldBy(run.text);
    EXPECT_GT(enough, limit) << run.text;
    EXPECT_EQ(simplifiedWall(wall, mode, window, enough, 4096).status, Status::kOk) << run.text;
    ++told;
  }
  EXPECT_GT(held, 0);
  return told;
}
TEST(SimplifierMemory, SufficesForWallsOrSaysHowMuchDoes) {
  const TestMesh wall = fullGrid(12, slowRun() ? 24 : 400, 1);
  int told = 0;
  for (Mode mode : kModes)
    for (int64_t window : {0, 6000}) told += expectWallFits(wall, mode, window);
  EXPECT_GT(told, 0);
}

void expectProgress(Mode mode) {
  const TestMesh mesh = fullGrid(4, 4, 16);
  Recorder out;
  std::vector<Progress> told;
  Simplifier simplifier(toRatio(0.2, 300, mode), out,
                        [&](const Progress& p) { told.push_back(p); });
  MeshStream stream(mesh, {});
  copyStream(stream, simplifier);
  ASSERT_GT(told.size(), 3u);
  for (size_t i = 1; i < told.size(); ++i) {
    EXPECT_GE(told[i].cells_read, told[i - 1].cells_read);
    EXPECT_GE(told[i].cells_written, told[i - 1].cells_written);
    EXPECT_GE(told[i].fraction, told[i - 1].fraction);
  }
  EXPECT_EQ(told.back().cells_read, static_cast<int64_t>(mesh.cellCount()));
  EXPECT_EQ(told.back().cells_written, static_cast<int64_t>(out.mesh.cellCount()));
  EXPECT_EQ(told.back().fraction, 1);
}
TEST(SimplifierProgress, GrowsAndEndsAtTheWhole) {
  for (Mode mode : kModes) expectProgress(mode);
}

// Or the time left would seem to be many times what it is.
TEST(SimplifierProgress, CountsWhatWasReadOfAMeshHeldWhole) {
  const TestMesh mesh = fullGrid(8, 8, 8);
  Recorder out;
  std::vector<double> told;
  Simplifier simplifier(toRatio(0.02, 0, Mode::kQueue), out,
                        [&](const Progress& p) { told.push_back(p.fraction); });
  MeshStream stream(mesh, {});
  copyStream(stream, simplifier);
  ASSERT_GT(told.size(), 2u);
  EXPECT_GT(told.front(), 0.2);
  EXPECT_LT(told.front(), 0.25);
}

TEST(SimplifierProgress, CanCancelAtAnyCall) {
  const TestMesh mesh = fullGrid(4, 4, 16);
  for (Mode mode : kModes)
    for (int allowed = 0; allowed < 4; ++allowed) {
      Recorder out;
      int calls = 0;
      Simplifier simplifier(toRatio(0.2, 300, mode), out, [&](const Progress&) {
        if (calls++ == allowed) fail(Status::kCancelled, "enough");
      });
      MeshStream stream(mesh, {});
      EXPECT_EQ(thrownBy([&] { copyStream(stream, simplifier); }).first, Status::kCancelled);
      EXPECT_FALSE(out.finished);
    }
}

}  // namespace
}  // namespace tetstream::test
