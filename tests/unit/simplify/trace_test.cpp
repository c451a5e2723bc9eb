// The vertex map and the log of collapses: every vertex once, in the cell that it lies in, with
// weights that give its position back; and collapses that make the output when they are done again.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "barycentric.h"
#include "simplify_testing.h"

namespace tetstream::test {
namespace {

struct Traces final : MapSink, LogSink {
  void begin() override { ++map_begins; }
  void put(const MapRows& rows) override {
    EXPECT_GT(rows.count, 0u);
    EXPECT_LE(rows.count, kTraceRows);
    vertices.insert(vertices.end(), rows.vertices, rows.vertices + rows.count);
    cells.insert(cells.end(), rows.cells, rows.cells + rows.count);
    weights.insert(weights.end(), rows.weights, rows.weights + 4 * rows.count);
  }
  void begin(const Schema& input) override {
    ++log_begins;
    for (const Column& c : input.fields)
      if (isFloat(c.type)) width += static_cast<size_t>(c.components);
  }
  void put(const LogRows& rows) override {
    EXPECT_GT(rows.count, 0u);
    EXPECT_LE(rows.count, kTraceRows);
    kept.insert(kept.end(), rows.kept, rows.kept + rows.count);
    removed.insert(removed.end(), rows.removed, rows.removed + rows.count);
    positions.insert(positions.end(), rows.positions, rows.positions + 3 * rows.count);
    if (width) values.insert(values.end(), rows.values, rows.values + width * rows.count);
    errors.insert(errors.end(), rows.errors, rows.errors + rows.count);
  }
  void finish() override { ++finishes; }

  std::vector<int64_t> vertices, cells, kept, removed;
  std::vector<double> weights, positions, values, errors;
  size_t width = 0;
  int map_begins = 0, log_begins = 0, finishes = 0;
};

struct Traced {
  Result result;
  Traces traces;
};

Traced traced(const TestMesh& mesh, const SimplifyOptions& options, const Cut& cut = {}) {
  Traced t;
  Simplifier simplifier(options, t.result.out, {});
  simplifier.trace({&t.traces, &t.traces});
  MeshStream stream(mesh, cut);
  copyStream(stream, simplifier);
  t.result.report = simplifier.report();
  return t;
}

TestMesh withField(TestMesh mesh) {
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(x * y) - z; });
  return mesh;
}

double linear(const TestMesh& mesh, size_t v) {
  return 3 * mesh.position(v, 0) - 5 * mesh.position(v, 1) + 2 * mesh.position(v, 2) + 7;
}

// What must hold of every map; returns how many vertices lie outside.
size_t expectMap(const TestMesh& in, const Traced& t) {
  const TestMesh& out = t.result.out.mesh;
  const Traces& map = t.traces;
  std::vector<int> used(in.vertexCount(), 0), came(in.vertexCount(), 0);
  for (int64_t v : in.cells) used[static_cast<size_t>(v)] = 1;
  EXPECT_TRUE(std::is_sorted(map.cells.begin(), map.cells.end()));
  size_t outside = 0;
  for (size_t i = 0; i < map.vertices.size(); ++i) {
    const auto v = static_cast<size_t>(map.vertices[i]);
    ++came[v];
    const int64_t* corners = &out.cells[4 * static_cast<size_t>(map.cells[i])];
    const double* w = &map.weights[4 * i];
    double sum = 0, value = 0, largest = 0;
    for (int k = 0; k < 4; ++k) {
      sum += w[k];
      largest = std::max(largest, std::fabs(linear(out, static_cast<size_t>(corners[k]))));
      value += w[k] * linear(out, static_cast<size_t>(corners[k]));
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    // A weight nearer to 0 than that from below became 0.
    EXPECT_NEAR(value, linear(in, v), kLeastOutside * std::max(largest, 10.0));
    const double least = *std::min_element(w, w + 4);
    EXPECT_TRUE(least >= 0 || least <= -kLeastOutside);
    outside += least < 0;
  }
  EXPECT_EQ(came, used);
  EXPECT_EQ(map.map_begins, 1);
  EXPECT_EQ(map.finishes, 2);
  return outside;
}

using Cell = std::array<std::array<double, 3>, 4>;

std::multiset<Cell> cellsOf(const TestMesh& mesh) {
  std::multiset<Cell> cells;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    Cell cell;
    for (size_t k = 0; k < 4; ++k)
      for (int i = 0; i < 3; ++i)
        cell[k][static_cast<size_t>(i)] =
            mesh.position(static_cast<size_t>(mesh.cells[4 * c + k]), i);
    cells.insert(cell);
  }
  return cells;
}

// The input after the collapses of the log.
TestMesh replayed(const TestMesh& in, const Traces& log) {
  std::vector<int64_t> into(in.vertexCount());
  std::vector<double> positions;
  for (size_t v = 0; v < in.vertexCount(); ++v) {
    into[v] = static_cast<int64_t>(v);
    for (int i = 0; i < 3; ++i) positions.push_back(in.position(v, i));
  }
  for (size_t i = 0; i < log.kept.size(); ++i) {
    const auto u = static_cast<size_t>(log.kept[i]), v = static_cast<size_t>(log.removed[i]);
    EXPECT_EQ(into[u], log.kept[i]) << "a vertex that is gone";
    EXPECT_EQ(into[v], log.removed[i]) << "a vertex that is gone";
    into[v] = log.kept[i];
    std::copy_n(&log.positions[3 * i], 3, &positions[3 * u]);
  }
  const auto find = [&](int64_t v) {
    while (into[static_cast<size_t>(v)] != v) v = into[static_cast<size_t>(v)];
    return v;
  };
  std::vector<int64_t> cells;
  for (size_t c = 0; c < in.cellCount(); ++c) {
    int64_t k[4];
    for (size_t j = 0; j < 4; ++j) k[j] = find(in.cells[4 * c + j]);
    if (std::set<int64_t>(k, k + 4).size() == 4) cells.insert(cells.end(), k, k + 4);
  }
  return makeMesh(ScalarType::kFloat64, positions, cells);
}

void expectTraces(const TestMesh& in, const SimplifyOptions& options) {
  const Traced t = traced(in, options);
  expectMap(in, t);
  EXPECT_EQ(static_cast<int64_t>(t.traces.kept.size()), t.result.report.collapses);
  EXPECT_EQ(cellsOf(replayed(in, t.traces)), cellsOf(t.result.out.mesh));
  // Nothing else is different.
  EXPECT_EQ(simplified(in, options).out.allBytes(), t.result.out.allBytes());
}

TEST(Traces, TellOfEveryVertexAndCollapseInEveryModeAndWindow) {
  for (Mode mode : kModes)
    for (int64_t window : {0, 400, 64})
      for (ScalarType type : {ScalarType::kFloat32, ScalarType::kFloat64}) {
        if (slowRun() && (window == 400 || type == ScalarType::kFloat64)) continue;
        expectTraces(withField(fullGrid(6, 6, 12, 0.1, type)), toRatio(0.3, window, mode));
      }
}

TEST(Traces, TellOfStrongReductions) {
  for (Mode mode : kModes)
    expectTraces(fullGrid(8, 8, slowRun() ? 8 : 16, 0.1), toRatio(0.02, 1500, mode));
  const int n = slowRun() ? 6 : 16, length = slowRun() ? 12 : 24;
  for (Mode mode : kModes) expectTraces(fullGrid(n, n, length, 0.1), toRatio(0.1, 0, mode));
}

TEST(Traces, TellOfCellsThatWereParked) {
  for (int64_t window : {1500, 400}) {
    if (slowRun() && window == 1500) continue;
    const TestMesh mesh = withField(fullGrid(6, 6, slowRun() ? 12 : 24, 0.1));
    expectTraces(mesh, parking(toRatio(0.1, window)));
  }
}

TEST(Traces, TellOfDomainsWithHolesCracksAndSingularPlaces) {
  for (const TestMesh& mesh : {slitGrid(6), shellGrid(5), ringGrid(6), cubesAtEdge(3),
                               cubesAtVertex(3), apart(3), oneCell()})
    for (Mode mode : kModes) expectTraces(mesh, toRatio(0.4, 0, mode));
}

// Where cells are flipped otherwise: of flips no log tells.
TEST(Traces, LogCollapsesThatMakeTheCellsWhereSomeAreThin) {
  const TestMesh grid = fullGrid(6, 6, 12, 0.2);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) positions.push_back(grid.position(v, i) / (i < 2 ? 1 : 50));
  const TestMesh mesh = withField(makeMesh(ScalarType::kFloat64, positions, grid.cells));
  const SimplifyOptions options = toRatio(0.2);
  EXPECT_GT(simplified(mesh, options).report.flips, 0);
  const Traced t = traced(mesh, options);
  EXPECT_EQ(t.result.report.flips, 0);
  expectMap(mesh, t);
  EXPECT_EQ(cellsOf(replayed(mesh, t.traces)), cellsOf(t.result.out.mesh));
}

TEST(Traces, OfAnOutputThatIsTheInputAreOnes) {
  const TestMesh mesh = fullGrid(3, 3, 3);
  const Traced t = traced(mesh, toRatio(1));
  EXPECT_EQ(expectMap(mesh, t), 0u);
  EXPECT_TRUE(t.traces.kept.empty());
  for (size_t i = 0; i < t.traces.weights.size(); i += 4)
    EXPECT_EQ(std::count(&t.traces.weights[i], &t.traces.weights[i] + 4, 1.0), 1);
}

TEST(Traces, LeaveOutVerticesThatNoCellUses) {
  TestMesh mesh = fullGrid(3, 3, 3);
  const double far[3] = {99, 99, 99};
  mesh.positions.append(far, 1, sizeof far);
  const Traced t = traced(mesh, toRatio(0.5));
  expectMap(mesh, t);
  EXPECT_EQ(t.traces.vertices.size(), mesh.vertexCount() - 1);
}

// A box with flat sides that are kept flat, up to the rounding of minimizers.
TEST(Traces, PutNothingOutsideOfABoxThatStaysOne) {
  TestMesh mesh = fullGrid(8, 8, 8, 0, ScalarType::kFloat64);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return x + 2 * y - z; });
  const Traced t = traced(mesh, toRatio(0.5));
  expectMap(mesh, t);
  EXPECT_GT(*std::min_element(t.traces.weights.begin(), t.traces.weights.end()), -1e-4);
}

using FaceCorners = std::set<int64_t>;

FaceCorners faceOf(const TestMesh& mesh, size_t cell, size_t opposite) {
  FaceCorners face;
  for (size_t k = 0; k < 4; ++k)
    if (k != opposite) face.insert(mesh.cells[4 * cell + k]);
  return face;
}

// A boundary that is moved away from a vertex may come back by collapses of other cells; what is
// told of a vertex outside is told by a cell beside the boundary.
TEST(Traces, PutVerticesBeyondFacesOfTheBoundaryOnly) {
  const int n = slowRun() ? 9 : 12;
  const TestMesh grid = fullGrid(n, n, n, 0.1);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    const double x = grid.position(v, 0), y = grid.position(v, 1), z = grid.position(v, 2);
    const double hill = 3 * std::sin(0.6 * x) * std::sin(0.6 * y);
    positions.insert(positions.end(), {x, y, (z + hill) / 20});
  }
  const TestMesh mesh = withField(makeMesh(ScalarType::kFloat64, positions, grid.cells));
  for (Mode mode : kModes) {
    const Traced t = traced(mesh, toRatio(0.05, 0, mode));
    EXPECT_GT(expectMap(mesh, t), 100u);
    std::map<FaceCorners, int> cells_at;
    for (size_t c = 0; c < t.result.out.mesh.cellCount(); ++c)
      for (size_t j = 0; j < 4; ++j) ++cells_at[faceOf(t.result.out.mesh, c, j)];
    size_t beyond_others = 0;
    for (size_t i = 0; i < t.traces.weights.size(); ++i) {
      const auto cell = static_cast<size_t>(t.traces.cells[i / 4]);
      if (t.traces.weights[i] < -1e-9)
        beyond_others += cells_at[faceOf(t.result.out.mesh, cell, i % 4)] > 1;
    }
    EXPECT_EQ(beyond_others, 0u);
  }
}

// A vertex that was not moved is not described by others.
TEST(Traces, OfVerticesThatStandWhereTheyStoodAreOnes) {
  const TestMesh mesh = withField(fullGrid(6, 6, 8, 0.1));
  const Traced t = traced(mesh, toRatio(0.5));
  std::map<std::array<double, 3>, int> places;
  const TestMesh& out = t.result.out.mesh;
  for (size_t v = 0; v < out.vertexCount(); ++v)
    places[{out.position(v, 0), out.position(v, 1), out.position(v, 2)}] = 1;
  size_t stood = 0;
  for (size_t i = 0; i < t.traces.vertices.size(); ++i) {
    const auto v = static_cast<size_t>(t.traces.vertices[i]);
    if (!places.count({mesh.position(v, 0), mesh.position(v, 1), mesh.position(v, 2)})) continue;
    ++stood;
    EXPECT_EQ(std::count(&t.traces.weights[4 * i], &t.traces.weights[4 * i] + 4, 1.0), 1);
  }
  EXPECT_GT(stood, 50u);
}

TEST(Traces, AreTheSameHoweverTheStreamIsCut) {
  const TestMesh mesh = withField(fullGrid(6, 6, 12, 0.1));
  const Traced whole = traced(mesh, toRatio(0.3, 400));
  Cut cut;
  cut.batch_cells = 7;
  cut.empty_batches = true;
  const Traced pieces = traced(mesh, toRatio(0.3, 400), cut);
  EXPECT_EQ(whole.traces.vertices, pieces.traces.vertices);
  EXPECT_EQ(whole.traces.weights, pieces.traces.weights);
  EXPECT_EQ(whole.traces.kept, pieces.traces.kept);
  EXPECT_EQ(whole.traces.errors, pieces.traces.errors);
}

// The values of the log are those of the output, of every float field, in the schema's order.
void expectValuesOfOutput(ScalarType places, ScalarType values) {
  TestMesh mesh = fullGrid(5, 5, 5, 0.1, places);
  addPositionField(mesh, {"carried", 1, values}, [](double x, double, double z) { return x - z; });
  mesh.addIntegerField("label", [](size_t v) { return static_cast<int64_t>(v % 3); });
  mesh.addField({"measured", 2, values},
                [&](size_t v, int k) { return mesh.position(v, 0) * mesh.position(v, 1) + k; });
  SimplifyOptions options = toRatio(0.4);
  options.fields = {{"measured", 1}};
  const Traced t = traced(mesh, options);
  ASSERT_EQ(t.traces.width, 3u);
  const TestMesh& out = t.result.out.mesh;
  std::map<std::array<double, 3>, size_t> at;
  for (size_t v = 0; v < out.vertexCount(); ++v)
    at[{out.position(v, 0), out.position(v, 1), out.position(v, 2)}] = v;
  size_t found = 0;
  std::set<int64_t> seen;
  for (size_t i = t.traces.kept.size(); i-- > 0;) {
    const double* x = &t.traces.positions[3 * i];
    const bool is_last = seen.insert(t.traces.kept[i]).second;
    seen.insert(t.traces.removed[i]);
    const auto v = at.find({x[0], x[1], x[2]});
    if (!is_last || v == at.end()) continue;
    ++found;
    const double* logged = &t.traces.values[3 * i];
    EXPECT_EQ(logged[0], out.field(0, v->second));
    EXPECT_EQ(logged[1], out.field(2, v->second, 0));
    EXPECT_EQ(logged[2], out.field(2, v->second, 1));
  }
  EXPECT_GT(found, 20u);
}

TEST(Traces, LogTheValuesThatTheOutputHas) {
  for (ScalarType places : {k32, k64})
    for (ScalarType values : {k32, k64}) expectValuesOfOutput(places, values);
}

// A map takes memory that is there, and no cells leave early for it.
TEST(Traces, ChangeNothingWhereMemoryIsAmple) {
  const TestMesh mesh = withField(fullGrid(8, 8, slowRun() ? 20 : 60, 0.1));
  for (Mode mode : kModes) {
    SimplifyOptions options = toRatio(0.02, 2000, mode);
    options.memory_bytes = 1 << 30;
    const Traced t = traced(mesh, options);
    expectMap(mesh, t);
    expectReached(t.result);
    EXPECT_TRUE(simplified(mesh, options).out.allBytes() == t.result.out.allBytes());
  }
}

TEST(Traces, KeepToTheMemoryBudget) {
  const TestMesh mesh = withField(fullGrid(12, 12, 60, 0.1));
  Cut cut;
  cut.say_front = true;
  for (const auto& [ratio, megabytes] : {std::pair{0.3, 3}, {0.03, 3}, {0.03, 4}, {0.03, 6}}) {
    if (slowRun() && (ratio == 0.3 || megabytes == 4)) continue;
    SimplifyOptions options = toRatio(ratio);
    options.memory_bytes = megabytes << 20;
    const Traced t = traced(mesh, options, cut);
    expectMap(mesh, t);
    EXPECT_EQ(t.result.out.problem, "");
    EXPECT_LE(t.result.report.peak_window_bytes, static_cast<uint64_t>(options.memory_bytes));
  }
}

// Sinks may fail at any call.
struct Failing final : MapSink, LogSink {
  explicit Failing(int call) : left(call) {}
  void count() {
    if (--left == 0) fail(Status::kCallback, "enough");
  }
  void begin() override { count(); }
  void put(const MapRows&) override { count(); }
  void begin(const Schema&) override { count(); }
  void put(const LogRows&) override { count(); }
  void finish() override { count(); }
  int left;
};

TEST(Traces, StopARunWhenTheirSinkFails) {
  const TestMesh mesh = fullGrid(10, 10, 20, 0.1);
  int call = 1;
  for (;; ++call) {
    Failing sinks(call);
    Recorder out;
    Simplifier simplifier(toRatio(0.3, 4000), out, {});
    simplifier.trace({&sinks, &sinks});
    MeshStream stream(mesh, {});
    if (call > 100) break;
    try {
      copyStream(stream, simplifier);
      break;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::kCallback);
      EXPECT_FALSE(out.finished);
    }
  }
  EXPECT_GE(call, 6);
  EXPECT_LT(call, 100);
}

}  // namespace
}  // namespace tetstream::test
