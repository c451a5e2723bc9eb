// Cells that leave the window early are parked where few are to be left of a stream, and are
// simplified with all others at the end.
#include "parking.h"

#include <cmath>

#include "field_error.h"
#include "simplify_testing.h"
#include "slow_run.h"
#include "topology.h"

namespace tetstream::test {
namespace {

constexpr int64_t kWindow = 131072;

double timesFor(int64_t cells, const SimplifyOptions& options, const Pilot& pilot = {}) {
  Schema schema;
  schema.cell_count = cells;
  return parkedTimes(schema, options, kWindow, pilot);
}

TEST(Parking, IsForLongStreamsOfWhichFewCellsAreLeft) {
  EXPECT_DOUBLE_EQ(timesFor(2000000, toRatio(0.1)), 262144 / 200000.0);
  EXPECT_DOUBLE_EQ(timesFor(2000000, {}), 262144 / 200000.0) << "the usual ratio";
  EXPECT_EQ(timesFor(2000000, toRatio(0.02)), 4);
  EXPECT_EQ(timesFor(2000000, toRatio(0.001)), 50) << "a twentieth of all";
  EXPECT_DOUBLE_EQ(timesFor(100000000, toRatio(0.0001)), 262144 / 10000.0);
  EXPECT_EQ(timesFor(2100000, toRatio(0.1)), 1) << "too many for what may be parked";
  EXPECT_EQ(timesFor(300000, toRatio(0.3)), 1) << "too large a part";
  EXPECT_EQ(timesFor(kWindow, toRatio(0.1)), 1) << "held whole";
  EXPECT_EQ(timesFor(-1, toRatio(0.1)), 1) << "of unknown length";
  EXPECT_EQ(timesFor(2000000, toRatio(0.1), {1e-6, {0, 1}}), 1) << "the bound is known";
  EXPECT_GT(timesFor(2000000, toRatio(0.1), {0, {0, 1}}), 1) << "only a sample was taken";
  Schema tiny;
  tiny.cell_count = 2000000;
  tiny.vertex_count = 1000001;
  EXPECT_EQ(parkedTimes(tiny, {}, kWindow, {}), 1) << "bodies of a few cells";
  --tiny.vertex_count;
  EXPECT_GT(parkedTimes(tiny, {}, kWindow, {}), 1);
  SimplifyOptions high;
  high.effort = Effort::kHigh;
  EXPECT_DOUBLE_EQ(timesFor(4000000, high), 1048576 / 400000.0);
  SimplifyOptions counted;
  counted.cells = 100000;
  EXPECT_DOUBLE_EQ(timesFor(5000000, counted), 2.62144);
}

TEST(Parking, IsNotForWhatAsksForMemoryOrAnotherWayThroughTheStream) {
  EXPECT_EQ(timesFor(2000000, toRatio(0.1, kWindow)), 1);
  for (Mode mode : {Mode::kPaper, Mode::kQueue})
    EXPECT_EQ(timesFor(2000000, toRatio(0.1, 0, mode)), 1);
  SimplifyOptions budgeted = toRatio(0.1), bounded = budgeted, dearest = budgeted, even = budgeted;
  budgeted.memory_bytes = 256 << 20;
  bounded.error = 1;
  dearest.release = ReleaseOrder::kError;
  even.uniform_ratio = true;
  for (const SimplifyOptions& options : {budgeted, bounded, dearest, even}) {
    EXPECT_EQ(timesFor(2000000, options), 1);
    EXPECT_EQ(timesFor(2000000, parking(options)), 1);
  }
  EXPECT_EQ(timesFor(2000000, parking(toRatio(0.1, kWindow))), 2) << "for comparisons";
}

// Cells round a face, each with a vertex of its own beside its three.
TEST(ParkedCells, StayUntilTheyAreTakenBack) {
  Account account;
  Topology mesh(account, 8, 16);
  for (int i = 0; i < 11; ++i) mesh.addVertex(kFinal);
  for (uint32_t c = 0; c < 8; ++c) {
    const uint32_t corners[4] = {0, 1, 2, 3 + c};
    mesh.addCell(corners, c == 4 ? kNegative : 0);
  }
  mesh.flagVertex(7, kWritten);
  mesh.park(1);
  mesh.park(4);
  mesh.kill(2);
  EXPECT_EQ(mesh.liveCells(), 5u);
  EXPECT_EQ(mesh.parkedCells(), 2u);
  EXPECT_FALSE(mesh.isLive(4));
  EXPECT_TRUE(mesh.isOfParked(7));
  EXPECT_FALSE(mesh.isOfParked(6));
  uint32_t keep[11];
  for (uint32_t v = 0; v < 11; ++v) keep[v] = v < 5 ? v : v == 5 ? kNone : v - 1;
  mesh.pack(keep, 10, [](uint32_t, uint32_t) {});
  EXPECT_EQ(mesh.cellEnd(), 7u);
  EXPECT_EQ(mesh.liveCells(), 5u);
  mesh.takeBack(kWritten);
  EXPECT_EQ(mesh.liveCells(), 7u);
  EXPECT_EQ(mesh.parkedCells(), 0u);
  for (uint32_t c = 0; c < 7; ++c) {
    EXPECT_TRUE(mesh.isLive(c));
    EXPECT_EQ(mesh.corners(c)[3], 3 + c);
  }
  EXPECT_FALSE(mesh.isOfParked(6));
  EXPECT_EQ(mesh.cellFlags(3), kNegative);
  EXPECT_EQ(mesh.vertexFlags(6), kFinal);
}

TestMesh wavyGrid(int n, int length) {
  TestMesh mesh = fullGrid(n, n, length, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return std::sin(0.9 * x) * std::cos(0.7 * y) + 0.3 * std::sin(0.4 * z + x) + 0.01 * z * z;
  });
  return mesh;
}

TEST(Parking, MeetsTheTargetAndTheWindow) {
  const int n = slowRun() ? 6 : 8;
  const TestMesh mesh = wavyGrid(n, 4 * n);
  for (Shape shape : {Shape::kField, Shape::kSolver})
    for (double ratio : {0.2, 0.05}) {
      SimplifyOptions options = parking(toRatio(ratio, 2000));
      options.shape = shape;
      const Result result = simplified(mesh, options);
      expectSound(mesh, result);
      expectReached(result);
      EXPECT_EQ(result.report.window_cells, 2000);
      EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(result.out.mesh)), "");
    }
}

// Of a stream that can hardly be simplified until near its end: from then on it is written as it
// comes.
TEST(Parking, StopsWhereTooManyCellsAreLeft) {
  TestMesh mesh = wavyGrid(6, 24);
  for (size_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked.push_back(mesh.position(v, 2) < 20);
  SimplifyOptions options = parking(toRatio(0.1, 1000));
  options.parked_cells = 1500;
  Result result;
  int64_t early = 0;
  Simplifier simplifier(options, result.out, [&early](const Progress& p) {
    if (p.cells_read < p.cells_total) early = p.cells_written;
  });
  MeshStream stream(mesh, Cut{});
  copyStream(stream, simplifier);
  result.report = simplifier.report();
  EXPECT_GT(early, 3000);
  EXPECT_LT(result.report.cells_out, result.report.cells_in);
  expectSound(mesh, result);
  EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(result.out.mesh)), "");
}

// A peak that has gone by when most of the stream comes is followed in the end as by windows alone,
// though these leave next to nothing.
TEST(Parking, KeepsAPeakThatComesEarly) {
  TestMesh mesh = fullGrid(12, 12, slowRun() ? 40 : 60, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return std::exp(-0.1 * ((x - 6) * (x - 6) + (y - 6) * (y - 6) + (z - 5) * (z - 5)));
  });
  const SimplifyOptions options = toRatio(0.003, 10000);
  const auto error = [&mesh](const SimplifyOptions& how) {
    return fieldErrors(mesh, simplified(mesh, how).out.mesh)[0];
  };
  const double alone = error(options);
  for (double times : {2, 4}) EXPECT_LT(error(parking(options, times)), alone) << times;
}

// In the geometric mean of some ratios: by itself each depends on where its windows end.
TEST(Parking, LowersTheError) {
  const TestMesh mesh = wavyGrid(10, 40);
  const auto error = [&mesh](const SimplifyOptions& options) {
    return fieldErrors(mesh, simplified(mesh, options).out.mesh)[0];
  };
  double all = 1;
  for (double ratio : {0.1, 0.05, 0.02}) {
    const SimplifyOptions options = toRatio(ratio, 6000);
    all *= error(parking(options, 1.4)) / error(options);
  }
  EXPECT_LT(std::cbrt(all), 0.97);
}

}  // namespace
}  // namespace tetstream::test
