// How much of a mesh is held, and how many passes over it find the bound that leaves what was
// asked for.
#include <cmath>
#include <limits>

#include "simplify_testing.h"

namespace tetstream::test {
namespace {

int64_t windowOf(int64_t cells, int64_t front, const SimplifyOptions& options) {
  Schema schema;
  schema.fields = {{"f", 1, ScalarType::kFloat32}};
  schema.cell_count = cells;
  schema.front_cells = front;
  return Simplifier::windowCells(schema, options);
}

TEST(SimplifierWindow, HoldsSmallMeshesWhole) {
  EXPECT_EQ(windowOf(262144, 500, {}), 262144);
  EXPECT_EQ(windowOf(1048576, 500, {}), 1048576);
  EXPECT_EQ(windowOf(1048577, 500, {}), 131072);
  EXPECT_EQ(windowOf(1048577, 50000, {}), 200000);
  EXPECT_EQ(windowOf(262144, 500, toRatio(0.02)), 262144);
  EXPECT_EQ(windowOf(1048576, 500, toRatio(0.02)), 1048576);
  EXPECT_EQ(windowOf(1048577, 500, toRatio(0.02)), 131072);
  EXPECT_EQ(windowOf(1048576, 500, toRatio(0.5)), 1048576);
  EXPECT_EQ(windowOf(1048577, 500, toRatio(0.5)), 131072);
  EXPECT_EQ(windowOf(262145, 500, toRatio(1)), 131072) << "nothing is to be simplified";
  SimplifyOptions counted;
  counted.cells = 30000;
  EXPECT_EQ(windowOf(120000, 500, counted), 120000);
  EXPECT_EQ(windowOf(360001, 500, counted), 360001);
  EXPECT_EQ(windowOf(1048577, 500, counted), 131072);
  counted.cells = 360001;
  EXPECT_EQ(windowOf(360001, 500, counted), 131072) << "nothing is to be simplified";
  SimplifyOptions to_error;
  to_error.error = 1;
  EXPECT_EQ(windowOf(262144, 500, to_error), 262144);
  EXPECT_EQ(windowOf(262145, 500, to_error), 131072);
  EXPECT_EQ(windowOf(-1, 500, {}), 131072) << "nobody knows how small it is";
  EXPECT_EQ(windowOf(200000, 500, toRatio(0.1, 3000)), 3000);
  EXPECT_EQ(windowOf(200000, 500, inMode(Mode::kPaper)), 16384);
  SimplifyOptions budgeted;
  budgeted.memory_bytes = 4 << 20;
  EXPECT_LT(windowOf(200000, 500, budgeted), 100000);
  budgeted.memory_bytes = std::numeric_limits<int64_t>::max();
  EXPECT_EQ(windowOf(200000, 500, budgeted), 200000);
}

TEST(SimplifierWindow, HoldsMoreFrontsWhereTheyAreWide) {
  EXPECT_EQ(windowOf(1000000000, 262143, {}), 4 * 262143);
  EXPECT_EQ(windowOf(1000000000, 262144, {}), 23 * 262144 / 4);
  EXPECT_EQ(windowOf(1000000, 262144, {}), 1000000) << "the mesh has no more";
  SimplifyOptions budgeted;
  budgeted.memory_bytes = 64 << 20;
  EXPECT_LT(windowOf(1000000000, 1000000, budgeted), 64 << 20 >> 4);
}

double wavy(double x, double y, double z) {
  return std::sin(0.9 * x) * std::cos(0.7 * y) + 0.3 * std::sin(0.4 * z + x) + 0.01 * z * z;
}

// A mesh of one tile: progress is told once for a pass, and once more at the end.
int passesTo(double ratio, const TestMesh& mesh) {
  int told = 0;
  Recorder out;
  Simplifier simplifier(toRatio(ratio), out, [&](const Progress&) { ++told; });
  MeshStream stream(mesh, Cut{});
  copyStream(stream, simplifier);
  EXPECT_LE(simplifier.report().cells_out, simplifier.report().target_cells);
  return told - 1;
}

// From errors that are millions of times smaller. Fewer than two would leave the first one's seams;
// more, and small ones, are worth their time where less than a third of the cells is left.
TEST(SweepBounds, AreFoundInFewPasses) {
  for (ScalarType type : {ScalarType::kFloat32, ScalarType::kFloat64}) {
    if (slowRun() && type == ScalarType::kFloat32) continue;
    TestMesh mesh = fullGrid(11, 11, 22, 0.1);
    addPositionField(mesh, {"f", 1, type}, wavy);
    for (double ratio : {0.5, 0.2, 0.1, 0.02}) {
      const int passes = passesTo(ratio, mesh);
      EXPECT_GE(passes, 2) << ratio;
      EXPECT_LE(passes, ratio < 0.05 ? 12 : 8) << ratio;
    }
  }
}

}  // namespace
}  // namespace tetstream::test
