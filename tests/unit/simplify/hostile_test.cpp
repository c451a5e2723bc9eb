// Streams that break the rules: each is refused with a sentence that names the place.
#include <cmath>
#include <limits>

#include "simplify_testing.h"

namespace tetstream::test {
namespace {

// A small stream of two cells, changed by `damage` before it is pushed in one batch.
struct Push {
  std::vector<double> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  std::vector<double> field = {0, 1, 2, 3, 4};
  std::vector<int64_t> cells = {0, 1, 2, 3, 1, 2, 3, 4};
  std::vector<uint8_t> last_uses = {1, 0};  // vertex 0 with the first cell
  std::vector<double> density = {5, 6};
  std::vector<int64_t> finalized;
  uint64_t first_vertex = 0;
};

std::pair<Status, std::string> refusalOf(const std::function<void(Push&)>& damage) {
  Push push;
  damage(push);
  Schema schema;
  schema.position_type = ScalarType::kFloat64;
  schema.fields = {{"heat", 1, ScalarType::kFloat64}};
  schema.cell_data = {{"density", 1, ScalarType::kFloat64}};
  const void* fields[] = {push.field.data()};
  const void* cell_data[] = {push.density.data()};
  BatchView batch;
  batch.first_vertex = push.first_vertex;
  batch.vertex_count = push.positions.size() / 3;
  batch.positions = push.positions.data();
  batch.fields = fields;
  batch.cell_count = push.cells.size() / 4;
  batch.cells = push.cells.data();
  batch.last_uses = push.last_uses.data();
  batch.cell_data = cell_data;
  batch.finalized_count = push.finalized.size();
  batch.finalized = push.finalized.data();
  Recorder out;
  Simplifier simplifier({}, out, {});
  return thrownBy([&] {
    simplifier.begin(schema);
    simplifier.put(batch);
    simplifier.finish();
  });
}

void expectRefused(const std::function<void(Push&)>& damage,
                   const std::vector<std::string>& words) {
  const auto [status, text] = refusalOf(damage);
  EXPECT_EQ(status, Status::kBadData) << text;
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(HostileStream, IsTakenWithoutDamage) {
  EXPECT_EQ(refusalOf([](Push&) {}).second, "");
}
TEST(HostileStream, IsRefusedForAVertexThatWasNotDeclared) {
  expectRefused([](Push& p) { p.cells[6] = 5; }, {"cell 1", "vertex 5", "declared"});
  expectRefused([](Push& p) { p.cells[6] = -1; }, {"cell 1", "vertex -1"});
  expectRefused([](Push& p) { p.cells[2] = std::numeric_limits<int64_t>::max(); }, {"cell 0"});
  expectRefused([](Push& p) { p.cells[2] = std::numeric_limits<int64_t>::min(); }, {"cell 0"});
}
TEST(HostileStream, IsRefusedForAVertexThatWasFinal) {
  expectRefused([](Push& p) { p.last_uses[0] = 2; }, {"cell 1", "vertex 1", "finalized"});
}
TEST(HostileStream, IsRefusedForAVertexTwiceInACell) {
  expectRefused([](Push& p) { p.cells[7] = 1; }, {"cell 1", "vertex 1", "twice"});
}
TEST(HostileStream, IsRefusedForAVertexThatIsFinalTwice) {
  expectRefused([](Push& p) { p.finalized = {0}; }, {"vertex 0", "twice"});
  expectRefused([](Push& p) { p.finalized = {3, 3}; }, {"vertex 3", "twice"});
}
TEST(HostileStream, IsRefusedForAFinalVertexThatWasNotDeclared) {
  expectRefused([](Push& p) { p.finalized = {5}; }, {"vertex 5", "declared"});
  expectRefused([](Push& p) { p.finalized = {-1}; }, {"vertex -1"});
}
TEST(HostileStream, IsRefusedForAGapBetweenItsBatches) {
  expectRefused([](Push& p) { p.first_vertex = 1; }, {"vertex 1", "vertex 0"});
}
TEST(HostileStream, IsRefusedForPositionsThatAreNotFinite) {
  for (double bad : {kNan, kInf, -kInf})
    expectRefused([bad](Push& p) { p.positions[7] = bad; }, {"vertex 2", "position"});
}
TEST(HostileStream, IsRefusedForMeasuredFieldsThatAreNotFinite) {
  for (double bad : {kNan, kInf, -kInf})
    expectRefused([bad](Push& p) { p.field[4] = bad; }, {"vertex 4", "heat"});
}
TEST(HostileStream, MayHaveCellDataThatAreNotFinite) {
  for (double bad : {kNan, kInf, -kInf})
    EXPECT_EQ(refusalOf([bad](Push& p) { p.density[1] = bad; }).second, "");
}

// The largest finite numbers: their squares and differences are not finite, and yet nothing may
// come out that is not.
TEST(HostileStream, OfTheLargestNumbersStaysFinite) {
  TestMesh mesh = fullGrid(3, 3, 4);
  addPositionField(mesh, {"huge", 1, ScalarType::kFloat64},
                   [](double x, double, double) { return x < 2 ? -1.7e308 : 1.7e308; });
  addPositionField(mesh, {"tiny", 1, ScalarType::kFloat64},
                   [](double x, double y, double) { return 4.9e-324 * (x + y); });
  for (Mode mode : kModes) {
    const Result result = simplified(mesh, toRatio(0.5, 0, mode));
    expectSound(mesh, result);
    for (size_t v = 0; v < result.out.mesh.vertexCount(); ++v)
      for (size_t f = 0; f < 2; ++f) EXPECT_TRUE(std::isfinite(result.out.mesh.field(f, v)));
  }
}

TEST(HostileStream, WithAWrongNumberOfCellsIsRefused) {
  for (int64_t claimed : {int64_t{0}, int64_t{1}, int64_t{70}, int64_t{1} << 20,
                          std::numeric_limits<int64_t>::max()}) {
    TestMesh lying = fullGrid(4, 4, 8);
    lying.schema.cell_count = claimed;
    Cut cut;
    cut.say_counts = false;
    const auto [status, text] = thrownBy([&] { simplified(lying, toRatio(0.2), cut); });
    EXPECT_EQ(status, Status::kBadData) << claimed;
    EXPECT_NE(text.find(textOf("announced %lld cells, 768 came", static_cast<long long>(claimed))),
              std::string::npos)
        << text;
  }
}

TEST(HostileStream, WithAWrongFrontIsStillSimplified) {
  const TestMesh mesh = fullGrid(4, 4, 8);
  for (int64_t claimed : {int64_t{0}, int64_t{1}, int64_t{70}, int64_t{1} << 40,
                          std::numeric_limits<int64_t>::max()}) {
    TestMesh lying = mesh;
    lying.schema.front_cells = claimed;
    lying.schema.front_span = lying.schema.front_width = claimed;
    for (Mode mode : kModes) {
      const Result result = simplified(lying, toRatio(0.2, 0, mode));
      expectSound(mesh, result);
      EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(result.out.mesh)), "");
      EXPECT_LT(result.out.mesh.cellCount(), mesh.cellCount() / 3);
    }
  }
}

}  // namespace
}  // namespace tetstream::test
