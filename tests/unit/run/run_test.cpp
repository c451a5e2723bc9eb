// The page that joins the pieces: pull and push, streamed and indexed, give the same.
#include "run.h"

#include <gtest/gtest.h>
#include <cmath>

#include "memory_source.h"
#include "mesh_facts.h"
#include "named_input.h"
#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

TestMesh richMesh() {
  TestMesh mesh = fullGrid(4, 4, 8, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(x + y) + 0.1 * z; });
  mesh.addIntegerField("label", [](size_t v) { return int64_t(v % 3); });
  mesh.addCellData({"d", 1, ScalarType::kFloat32}, [](size_t c, int) { return double(c % 5); });
  for (size_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked.push_back(v % 50 == 0);
  return mesh;
}

RunOptions toRatio(double ratio) {
  RunOptions options;
  options.simplify.ratio = ratio;
  options.simplify.window_cells = 300;
  return options;
}

Input streamed(const TestMesh& mesh, const Cut& cut = {}) {
  Input input;
  input.stream = std::make_unique<MeshStream>(mesh, cut);
  return input;
}

Input indexed(TestMesh& mesh) {
  Input input;
  input.indexed = std::make_unique<MemorySource>(mesh.schema, mesh.view());
  return input;
}

struct Result {
  Recorder out;
  Report report;
};

Result pulled(Input input, const RunOptions& options) {
  Result result;
  SimplifyRun run(options, result.out, {});
  run.run(input);
  result.report = run.report();
  return result;
}

Result pushed(const TestMesh& mesh, const RunOptions& options, bool as_indexed, const Cut& cut) {
  Result result;
  SimplifyRun run(options, result.out, {});
  MeshStream stream(mesh, cut);
  run.begin(stream.schema(), as_indexed);
  BatchView batch;
  while (stream.next(batch)) run.put(batch);
  run.finish();
  result.report = run.report();
  return result;
}

void expectSame(const Result& a, const Result& b) {
  EXPECT_EQ(a.out.problem, "");
  EXPECT_EQ(b.out.problem, "");
  EXPECT_TRUE(a.out.finished && b.out.finished);
  EXPECT_TRUE(a.out.allBytes() == b.out.allBytes());
  EXPECT_EQ(a.report.cells_in, b.report.cells_in);
  EXPECT_EQ(a.report.vertices_in, b.report.vertices_in);
  EXPECT_EQ(a.report.cells_out, b.report.cells_out);
  EXPECT_EQ(a.report.collapses, b.report.collapses);
  EXPECT_EQ(a.report.unused_vertices, b.report.unused_vertices);
  EXPECT_EQ(a.report.front_cells, b.report.front_cells);
}

TEST(SimplifyRun, GivesTheSamePushedAndPulled) {
  const TestMesh mesh = richMesh();
  const Result pull = pulled(streamed(mesh), toRatio(0.2));
  EXPECT_GT(pull.report.collapses, 10);
  EXPECT_GT(pull.report.seconds, 0);
  for (size_t batch : {size_t{3}, size_t{1000}}) {
    Cut cut;
    cut.batch_cells = batch;
    expectSame(pull, pushed(mesh, toRatio(0.2), false, cut));
  }
}

TEST(SimplifyRun, GivesTheSamePushedAndPulledForAnIndexedMesh) {
  TestMesh mesh = shuffled(richMesh(), 5);
  const Result pull = pulled(indexed(mesh), toRatio(0.2));
  EXPECT_GT(pull.report.collapses, 10);
  for (size_t batch : {size_t{3}, size_t{1000}}) {
    Cut cut;
    cut.batch_cells = batch;
    cut.all_vertices_first = batch == 3;
    expectSame(pull, pushed(mesh, toRatio(0.2), true, cut));
  }
  EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(pull.out.mesh)), "");
}

TEST(SimplifyRun, CountsUnusedPointsOfIndexedMeshes) {
  TestMesh mesh = makeMesh(ScalarType::kFloat32,
                           {5, 5, 5, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 6, 6, 6}, {1, 2, 3, 4});
  const Result result = pulled(indexed(mesh), toRatio(1));
  EXPECT_EQ(result.report.unused_vertices, 2);
  EXPECT_EQ(result.report.cells_out, 1);
}

TEST(SimplifyRun, TakesAnEmptyIndexedMesh) {
  TestMesh none = makeMesh(ScalarType::kFloat32, {}, {});
  const Result result = pulled(indexed(none), toRatio(0.5));
  EXPECT_TRUE(result.out.finished);
  EXPECT_EQ(result.report.cells_out, 0);
  expectSame(result, pushed(none, toRatio(0.5), true, {}));
}

TEST(SimplifyRun, TellsProgressInBothPhases) {
  TestMesh mesh = shuffled(richMesh(), 6);
  Recorder out;
  std::vector<std::pair<std::string, double>> told;
  SimplifyRun run(toRatio(0.2), out, [&](const Progress& p) {
    told.push_back({p.phase, p.fraction});
  });
  Input input = indexed(mesh);
  run.run(input);
  ASSERT_GT(told.size(), 4u);
  EXPECT_EQ(told.front().first, "order");
  EXPECT_EQ(told.back().first, "simplify");
  EXPECT_EQ(told.back().second, 1);
  for (size_t i = 1; i < told.size(); ++i) EXPECT_GE(told[i].second, told[i - 1].second);
}

// A mesh that can be read twice and is larger than its window is read by a pilot first: progress
// never turns back, and the paper's mode needs none.
TEST(SimplifyRun, ReadsAMeshTwiceForAPilot) {
  TestMesh mesh = shuffled(richMesh(), 6);
  for (Mode mode : {Mode::kSweep, Mode::kPaper, Mode::kQueue}) {
    RunOptions options = toRatio(0.2);
    options.simplify.mode = mode;
    Recorder out;
    std::vector<Progress> told;
    SimplifyRun run(options, out, [&](const Progress& p) { told.push_back(p); });
    Input input = indexed(mesh);
    run.run(input);
    EXPECT_EQ(out.problem, "");
    size_t pilots = 0;
    for (size_t i = 0; i < told.size(); ++i) {
      pilots += told[i].phase == std::string("pilot");
      if (told[i].phase == std::string("pilot")) {
        EXPECT_EQ(told[i].cells_written, 0);
      }
      if (i > 0) {
        EXPECT_GE(told[i].fraction, told[i - 1].fraction);
      }
    }
    EXPECT_EQ(pilots > 0, mode == Mode::kSweep);
    EXPECT_LE(run.report().cells_out, run.report().target_cells);
    EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(out.mesh)), "");
  }
}

struct Log final : LogSink {
  void begin(const Schema&) override {}
  void put(const LogRows&) override {}
  void finish() override {}
};

// An ample budget is as none: all of a small mesh is read by a pilot. What is traced has memory
// that only a budget that is planned for has room for.
TEST(SimplifyRun, GoesByABudgetWhereItIsTraced) {
  TestMesh mesh = richMesh();
  RunOptions options = toRatio(0.2);
  options.simplify.memory_bytes = int64_t{1} << 30;
  for (bool traced : {false, true}) {
    Recorder out;
    Log log;
    size_t pilots = 0;
    SimplifyRun run(options, out,
                    [&](const Progress& p) { pilots += p.phase == std::string("pilot"); });
    if (traced) run.trace({nullptr, &log});
    Input input = indexed(mesh);
    run.run(input);
    EXPECT_EQ(out.problem, "");
    EXPECT_EQ(pilots == 0, traced);
  }
}

TEST(SimplifyRun, CanBeCancelledWhileThePilotReads) {
  TestMesh mesh = richMesh();
  Recorder out;
  SimplifyRun run(toRatio(0.2), out, [](const Progress& p) {
    if (p.phase == std::string("pilot")) fail(Status::kCancelled, "enough");
  });
  Input input = indexed(mesh);
  EXPECT_THROW(run.run(input), Error);
  EXPECT_FALSE(out.finished);
}

TEST(SimplifyRun, CanBeCancelledWhileOrdering) {
  TestMesh mesh = richMesh();
  Recorder out;
  SimplifyRun run(toRatio(0.2), out, [](const Progress&) { fail(Status::kCancelled, "enough"); });
  Input input = indexed(mesh);
  EXPECT_THROW(run.run(input), Error);
  EXPECT_FALSE(out.finished);
}

// ----------------------------------------------------------------------- convert, inspect

TEST(Convert, CopiesAStream) {
  const TestMesh mesh = richMesh();
  Recorder out;
  Input input = streamed(mesh);
  std::vector<double> told;
  convert(input, out, {}, [&](const Progress& p) { told.push_back(p.fraction); });
  EXPECT_EQ(out.problem, "");
  EXPECT_TRUE(out.finished);
  EXPECT_TRUE(out.mesh.cells == mesh.cells);
  EXPECT_TRUE(out.mesh.positions.bytes == mesh.positions.bytes);
  EXPECT_TRUE(out.mesh.fields[1].bytes == mesh.fields[1].bytes);
  EXPECT_TRUE(out.mesh.cell_data[0].bytes == mesh.cell_data[0].bytes);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.back(), 1);
}

TEST(Convert, RefusesAStreamThatBreaksTheRules) {
  TestMesh mesh = richMesh();
  mesh.cells[4] = mesh.cells[5];
  Recorder out;
  Input input = streamed(mesh);
  try {
    convert(input, out, {}, {});
    ADD_FAILURE() << "nothing was refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kBadData);
    EXPECT_EQ(error.text().rfind("cell 1: ", 0), 0u) << error.text();
  }
}

TEST(Convert, OrdersAnIndexedMesh) {
  TestMesh mesh = shuffled(richMesh(), 7);
  Recorder out;
  Input input = indexed(mesh);
  RunOptions options;
  options.axis = "z";
  convert(input, out, options, {});
  EXPECT_EQ(out.problem, "");
  EXPECT_TRUE(out.exact_finalization);
  EXPECT_TRUE(out.compact);
  EXPECT_EQ(out.mesh.cellCount(), mesh.cellCount());
  EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(out.mesh)), "");
  EXPECT_NEAR(factsOf(mesh).volume, factsOf(out.mesh).volume, 1e-9);
}

TEST(Inspect, TellsTheSameOfAStreamAndOfTheMeshItCameFrom) {
  TestMesh mesh = shuffled(richMesh(), 8);
  Input first = indexed(mesh);
  const Schema a = inspect(first, {}, {}).schema;
  Recorder out;
  Input second = indexed(mesh);
  convert(second, out, {}, {});
  Cut cut;
  cut.say_counts = false;
  Input third = streamed(out.mesh, cut);
  const Schema b = inspect(third, {}, {}).schema;
  EXPECT_EQ(a.vertex_count, b.vertex_count);
  EXPECT_EQ(a.cell_count, b.cell_count);
  EXPECT_EQ(a.front_width, b.front_width);
  EXPECT_EQ(a.front_span, b.front_span);
  EXPECT_EQ(a.front_cells, b.front_cells);
  EXPECT_EQ(a.box_min, b.box_min);
  EXPECT_EQ(a.box_max, b.box_max);
  EXPECT_EQ(a.box_min.size(), 5u);
}

// Fields are measured then, unless there are too many components: a user has to name some of them.
TEST(Inspect, TellsTheWindowThatASimplificationTakes) {
  TestMesh mesh = fullGrid(8, 8, 60, 0.1);
  addPositionField(mesh, {"velocity", 3, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(x + y) + 0.1 * z; });
  RunOptions options;
  options.simplify.memory_bytes = 2 << 20;
  Input first = indexed(mesh);
  const int64_t told = inspect(first, options, {}).window_cells;
  EXPECT_EQ(told, pulled(indexed(mesh), options).report.window_cells);
  EXPECT_LT(told, static_cast<int64_t>(mesh.cellCount()));
  for (const char name : std::string("abcdefghijklmno"))
    addPositionField(mesh, {std::string(1, name), 9, ScalarType::kFloat32},
                     [](double x, double, double z) { return x * z; });
  Input second = indexed(mesh);
  EXPECT_LT(inspect(second, options, {}).window_cells, told);
}

// Unless it is told already: a name that is a word of the sentence is not.
TEST(ReadNamed, TellsWhichFileIsWrong) {
  const auto sentence = [](const std::string& name, const char* text) {
    Input input;
    input.name = name;
    try {
      readNamed(input, [&] { fail(Status::kBadData, "%s", text); });
    } catch (const Error& error) {
      return error.text();
    }
    return std::string();
  };
  EXPECT_EQ(sentence("cell", "cell 7: vertex 9 is not known"),
            "cell: cell 7: vertex 9 is not known");
  EXPECT_EQ(sentence("a.vtu", "a.vtu: cell 7 is flat"), "a.vtu: cell 7 is flat");
  EXPECT_EQ(sentence("a.vtu", "a.vtu, byte 7: no number"), "a.vtu, byte 7: no number");
  EXPECT_EQ(sentence("", "cell 7 is flat"), "cell 7 is flat");
}

}  // namespace
}  // namespace tetstream::test
