// The simplifier as a stage of a stream: the least inputs, and the same bytes however the stream
// was cut.
#include <cmath>

#include "simplify_testing.h"

namespace tetstream::test {
namespace {

double bowl(double x, double y, double z) {
  return x * x + 0.3 * y * z;
}

TestMesh richMesh(int n) {
  TestMesh mesh = fullGrid(n, n, 2 * n, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat32}, bowl);
  addPositionField(mesh, {"v", 3, ScalarType::kFloat64}, bowl);
  mesh.addIntegerField("label", [](size_t v) { return static_cast<int64_t>(v % 5); });
  mesh.addCellData({"density", 2, ScalarType::kFloat64},
                   [](size_t c, int i) { return static_cast<double>(c % 17 + 3 * i); });
  mesh.addIntegerCellData("id", [](size_t c) { return static_cast<int64_t>(c); });
  for (size_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked.push_back(v % 97 == 0);
  return mesh;
}

TEST(SimplifierStream, PassesOneCellOn) {
  const TestMesh mesh = oneCell();
  const Result result = simplified(mesh, toRatio(0.1));
  expectSound(mesh, result);
  EXPECT_EQ(result.out.mesh.cells, mesh.cells);
  EXPECT_EQ(result.out.mesh.positions.bytes, mesh.positions.bytes);
}

TEST(SimplifierStream, PassesAnEmptyStreamOn) {
  const TestMesh mesh = makeMesh(ScalarType::kFloat32, {}, {});
  const Result result = simplified(mesh, toRatio(0.5));
  expectSound(mesh, result);
  EXPECT_EQ(result.out.mesh.cellCount(), 0u);
}

TEST(SimplifierStream, DropsVerticesWithoutCells) {
  TestMesh mesh =
      makeMesh(ScalarType::kFloat64,
               {9, 9, 9, 0, 0, 0, 1, 0, 0, 8, 8, 8, 0, 1, 0, 0, 0, 1, 7, 7, 7}, {1, 2, 4, 5});
  for (bool explicit_final : {false, true}) {
    Cut cut;
    cut.explicit_final = explicit_final;
    const Result result = simplified(mesh, toRatio(0.5), cut);
    expectSound(mesh, result);
    EXPECT_EQ(result.report.unused_vertices, 3);
    EXPECT_EQ(result.out.mesh.vertexCount(), 4u);
    EXPECT_EQ(result.out.mesh.position(1, 0), 1);
  }
  const TestMesh only = makeMesh(ScalarType::kFloat64, {0, 0, 0, 1, 1, 1}, {});
  EXPECT_EQ(simplified(only, toRatio(0.5)).report.unused_vertices, 2);
}

void expectSameWhateverTheBatches(const TestMesh& mesh, const SimplifyOptions& asked) {
  for (int64_t window : {64, 700, 0}) {
    SimplifyOptions options = asked;
    options.window_cells = window;
    const Result first = simplified(mesh, options);
    expectSound(mesh, first);
    for (size_t batch : {size_t{1}, size_t{7}, size_t{100000}})
      for (int form = 0; form < 4; ++form) {
        if (slowRun() && (form > 1 || batch == 1)) continue;
        SCOPED_TRACE(textOf("window %lld, batches of %zu, form %d", static_cast<long long>(window),
                            batch, form));
        Cut cut;
        cut.batch_cells = batch;
        cut.explicit_final = form & 1;
        cut.empty_batches = form & 2;
        const Result other = simplified(mesh, options, cut);
        EXPECT_EQ(other.out.problem, "");
        EXPECT_TRUE(other.out.allBytes() == first.out.allBytes());
        EXPECT_EQ(other.report.collapses, first.report.collapses);
        EXPECT_EQ(other.report.front_cells, first.report.front_cells);
        EXPECT_EQ(other.report.rejected_link, first.report.rejected_link);
        EXPECT_EQ(other.report.largest_error, first.report.largest_error);
        EXPECT_EQ(other.out.batches, first.out.batches);
      }
  }
}
TEST(SimplifierStream, GivesTheSameBytesWhateverTheBatches) {
  const TestMesh mesh = richMesh(slowRun() ? 3 : 6);
  for (Mode mode : kModes) expectSameWhateverTheBatches(mesh, toRatio(0.2, 0, mode));
  expectSameWhateverTheBatches(mesh, parking(toRatio(0.2)));
}

// Where in the stream a vertex is declared before its first cell has no meaning.
TEST(SimplifierStream, GivesTheSameBytesWhenVerticesComeLongBefore) {
  const TestMesh mesh = richMesh(slowRun() ? 3 : 5);
  for (Mode mode : kModes) {
    const Result first = simplified(mesh, toRatio(0.2, 300, mode));
    Cut cut;
    cut.all_vertices_first = true;
    for (size_t batch : {size_t{7}, size_t{4096}}) {
      cut.batch_cells = batch;
      const Result other = simplified(mesh, toRatio(0.2, 300, mode), cut);
      EXPECT_TRUE(other.out.allBytes() == first.out.allBytes());
    }
  }
}

// Where there are so many tiles that their number tells on the result, too.
TEST(SimplifierStream, GivesTheSameTilesWhenVerticesComeLongBefore) {
  const TestMesh mesh = fullGrid(6, 6, 40);
  SimplifyOptions options = toRatio(0.2, 2500);
  options.tile_vertices = 64;
  const Result first = simplified(mesh, options);
  Cut cut;
  cut.all_vertices_first = true;
  EXPECT_TRUE(simplified(mesh, options, cut).out.allBytes() == first.out.allBytes());
}

// What no patch holds is simplified in parts.
TEST(SimplifierStream, IsSimplifiedInTilesThatTouchMoreCellsThanAPatchHolds) {
  const TestMesh mesh = fullGrid(24, 24, 24);
  SimplifyOptions options = toRatio(0.5);
  options.tile_vertices = 1 << 17;
  const Result result = simplified(mesh, options);
  EXPECT_EQ(result.report.limited_by, "");
  EXPECT_GT(result.report.collapses, 3000);
}

// Where choices are random, another seed gives another mesh.
TEST(SimplifierStream, GivesTheSameBytesTwiceAndOthersForAnotherSeed) {
  const TestMesh mesh = richMesh(4);
  for (Mode mode : kModes) {
    SimplifyOptions options = toRatio(0.3, 0, mode);
    const auto bytes = [&] { return simplified(mesh, options).out.allBytes(); };
    const auto first = bytes();
    EXPECT_TRUE(bytes() == first);
    options.seed = 2;
    EXPECT_EQ(bytes() == first, mode != Mode::kPaper);
  }
}

// A consumer that holds only what is active must not need more than the input's consumer did.
TEST(SimplifierStream, KeepsTheOrderSoThatTheFrontStaysLow) {
  const TestMesh mesh = fullGrid(5, 5, slowRun() ? 10 : 60);
  for (Mode mode : kModes) {
    const Result result = simplified(mesh, toRatio(0.3, 1200, mode));
    expectSound(mesh, result);
    expectReached(result);
    double highest = -1, fall = 0;
    const TestMesh& out = result.out.mesh;
    for (size_t c = 0; c < out.cellCount(); ++c) {
      const double z = out.position(static_cast<size_t>(out.cells[4 * c]), 2);
      fall = std::max(fall, highest - z);
      highest = std::max(highest, z);
    }
    EXPECT_LT(fall, 10);  // a window is 8 layers of 150 cells
  }
}

// A mesh that can be held whole is, whether or not its front and its cells are told beforehand; the
// paper's modes have a small window.
TEST(SimplifierStream, HasAWindowForASmallMeshWhateverIsTold) {
  TestMesh mesh = fullGrid(18, 18, 18);
  const auto count = static_cast<int64_t>(mesh.cellCount());
  EXPECT_GT(count, 32768);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return std::sin(0.3 * x + 0.1 * y * z); });
  addPositionField(mesh, {"g", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return x + 2 * y - z; });
  const auto windowOf = [&](int64_t front, bool counted, Mode mode, Result& result) {
    mesh.schema.front_cells = front;
    Cut cut;
    cut.say_counts = counted;
    SimplifyOptions options = toRatio(0.1);
    options.mode = mode;
    result = simplified(mesh, options, cut);
    return result.report.window_cells;
  };
  Result told, untold, uncounted, paper;
  EXPECT_EQ(windowOf(3000, true, Mode::kSweep, told), count);
  EXPECT_EQ(windowOf(-1, true, Mode::kSweep, untold), count);
  EXPECT_GE(windowOf(-1, false, Mode::kSweep, uncounted), count);
  EXPECT_TRUE(untold.out.allBytes() == told.out.allBytes());
  EXPECT_TRUE(uncounted.out.allBytes() == told.out.allBytes());
  EXPECT_EQ(windowOf(-1, true, Mode::kPaper, paper), 32768);
}

TEST(SimplifierStream, TellsTheSameFrontAsTheStreamHas) {
  const TestMesh mesh = fullGrid(4, 4, 12);
  Cut whole;
  whole.batch_cells = 1000000;
  Cut small;
  small.batch_cells = 5;
  const Report a = simplified(mesh, toRatio(0.5, 400), whole).report;
  const Report b = simplified(mesh, toRatio(0.5, 400), small).report;
  EXPECT_EQ(a.front_width, b.front_width);
  EXPECT_EQ(a.front_span, b.front_span);
  EXPECT_GT(a.front_width, 25);
  EXPECT_LT(a.front_width, 75);
}

}  // namespace
}  // namespace tetstream::test
