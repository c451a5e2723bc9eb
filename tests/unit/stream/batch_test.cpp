// Batches, schemas, sources in memory, and rounding to float32.
#include "batch.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "memory_source.h"
#include "rounding_source.h"
#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

Schema mixedSchema() {
  Schema s;
  s.position_type = ScalarType::kFloat64;
  s.fields = {{"a", 2, ScalarType::kFloat64}, {"b", 1, ScalarType::kInt32}};
  s.cell_data = {{"c", 3, ScalarType::kInt64}};
  return s;
}

TEST(Batch, KeepsRowsWhileItGrows) {
  Batch batch(mixedSchema());
  batch.clear(7);
  EXPECT_TRUE(batch.empty());
  for (int k = 0; k < 1000; ++k) {
    const size_t row = batch.addVertices(1);
    const double position[3] = {k + 0.5, k + 0.25, k + 0.125}, a[2] = {double(k), -double(k)};
    const int32_t b = 3 * k;
    std::memcpy(batch.position(row), position, sizeof position);
    std::memcpy(batch.field(0, row), a, sizeof a);
    std::memcpy(batch.field(1, row), &b, sizeof b);
    const size_t cell = batch.addCells(1);
    for (int j = 0; j < 4; ++j) batch.cell(cell)[j] = k + j;
    const int64_t c[3] = {k, k + 1, k + 2};
    std::memcpy(batch.cellData(0, cell), c, sizeof c);
  }
  batch.lastUses(999) = 5;
  const BatchView v = batch.view();
  EXPECT_EQ(v.first_vertex, 7u);
  EXPECT_EQ(v.vertex_count, 1000u);
  EXPECT_EQ(v.cell_count, 1000u);
  EXPECT_EQ(v.locked, nullptr);
  for (int k = 0; k < 1000; ++k) {
    EXPECT_EQ(static_cast<const double*>(v.positions)[3 * k + 1], k + 0.25);
    EXPECT_EQ(static_cast<const double*>(v.fields[0])[2 * k + 1], -k);
    EXPECT_EQ(static_cast<const int32_t*>(v.fields[1])[k], 3 * k);
    EXPECT_EQ(v.cells[4 * k + 3], k + 3);
    EXPECT_EQ(v.last_uses[k], k == 999 ? 5 : 0);
    EXPECT_EQ(static_cast<const int64_t*>(v.cell_data[0])[3 * k + 2], k + 2);
  }
}

TEST(Batch, ForgetsEverythingWhenCleared) {
  Batch batch(mixedSchema());
  batch.clear(0);
  batch.addVertices(3);
  batch.lock(1);
  batch.addCells(2);
  batch.lastUses(1) = 15;
  batch.addFinalized(2);
  const int64_t face[3] = {0, 1, 2};
  batch.addFace(face, 9);
  BatchView v = batch.view();
  ASSERT_NE(v.locked, nullptr);
  EXPECT_EQ(v.locked[0] + 10 * v.locked[1] + 100 * v.locked[2], 10);
  EXPECT_EQ(v.finalized_count, 1u);
  EXPECT_EQ(v.face_count, 1u);
  EXPECT_EQ(v.face_labels[0], 9);
  EXPECT_EQ(v.faces[2], 2);
  batch.clear(3);
  EXPECT_TRUE(batch.empty());
  batch.addVertices(2);
  batch.addCells(2);
  v = batch.view();
  EXPECT_EQ(v.locked, nullptr);
  EXPECT_EQ(v.last_uses[1], 0);
  EXPECT_EQ(v.finalized_count + v.face_count, 0u);
}

std::string refusalOf(const Schema& schema) {
  try {
    checkSchema(schema);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kBadArgument);
    return error.text();
  }
  return "";
}

TEST(Schema, IsCheckedColumnByColumn) {
  const auto with = [](const std::function<void(Schema&)>& change) {
    Schema s = mixedSchema();
    change(s);
    return refusalOf(s);
  };
  EXPECT_EQ(with([](Schema&) {}), "");
  EXPECT_NE(with([](Schema& s) { s.position_type = ScalarType::kInt32; }), "");
  EXPECT_NE(with([](Schema& s) { s.fields[1].name = ""; }), "");
  EXPECT_NE(with([](Schema& s) { s.fields[1].name = std::string(256, 'x'); }), "");
  EXPECT_EQ(with([](Schema& s) { s.fields[1].name = std::string(255, 'x'); }), "");
  EXPECT_NE(with([](Schema& s) { s.fields[1].name = "a"; }).find("twice"), std::string::npos);
  EXPECT_EQ(with([](Schema& s) { s.cell_data[0].name = "a"; }), "");  // a kind of its own
  EXPECT_NE(with([](Schema& s) { s.fields[0].components = 0; }), "");
  EXPECT_NE(with([](Schema& s) { s.fields[0].components = 10; }).find("\"a\""), std::string::npos);
  EXPECT_NE(with([](Schema& s) { s.cell_data[0].type = static_cast<ScalarType>(5); }), "");
}

TEST(MemorySource, GivesAnyRange) {
  TestMesh mesh = fullGrid(2, 2, 2);
  addPositionField(mesh, {"f", 2, ScalarType::kFloat32},
                   [](double x, double, double) { return x; });
  mesh.addIntegerCellData("id", [](size_t c) { return static_cast<int64_t>(c) * 11; });
  MemorySource source(mesh.schema, mesh.view());
  EXPECT_EQ(source.schema().vertex_count, 27);
  EXPECT_EQ(source.schema().cell_count, 48);
  EXPECT_TRUE(source.randomAccess());
  for (uint64_t first : {0, 5, 26})
    for (size_t count : {size_t{0}, size_t{1}, static_cast<size_t>(27 - first)}) {
      std::vector<double> positions(3 * count + 1, -1);
      std::vector<float> field(2 * count + 1, -1);
      source.readPositions(first, count, positions.data());
      source.readField(0, first, count, field.data());
      for (size_t i = 0; i < count; ++i) {
        EXPECT_EQ(positions[3 * i + 2], mesh.position(first + i, 2));
        EXPECT_EQ(field[2 * i + 1], mesh.field(0, first + i, 1));
      }
      EXPECT_EQ(positions[3 * count], -1);
    }
  int64_t cells[8], ids[2];
  source.readCells(46, 2, cells);
  source.readCellData(0, 46, 2, ids);
  EXPECT_TRUE(std::equal(cells, cells + 8, &mesh.cells[4 * 46]));
  EXPECT_EQ(ids[1], 47 * 11);
}

TEST(MemorySource, RefusesIdsThatAreNoVertices) {
  for (int64_t bad : {int64_t{-1}, int64_t{4}, std::numeric_limits<int64_t>::min()}) {
    TestMesh mesh = oneCell();
    mesh.cells[2] = bad;
    MemorySource source(mesh.schema, mesh.view());
    int64_t cells[4];
    try {
      source.readCells(0, 1, cells);
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::kBadData);
      EXPECT_NE(error.text().find("cell 0: vertex " + std::to_string(bad)), std::string::npos);
    }
  }
}

// ------------------------------------------------------------------------------- rounding

TestMesh doubleMesh() {
  TestMesh mesh = fullGrid(2, 2, 3, 0.1);
  addPositionField(mesh, {"d", 3, ScalarType::kFloat64},
                   [](double x, double y, double) { return 0.1 + x * y / 7; });
  addPositionField(mesh, {"s", 1, ScalarType::kFloat32},
                   [](double x, double, double) { return x; });
  mesh.addIntegerField("label", [](size_t v) { return (int64_t{1} << 60) + int64_t(v); });
  mesh.addCellData({"exact", 1, ScalarType::kFloat64},
                   [](size_t c, int) { return 0.1 * double(c); });
  return mesh;
}

// What rounding may change and what not, value by value.
void expectRounded(const TestMesh& mesh, const TestMesh& out) {
  EXPECT_EQ(out.schema.position_type, ScalarType::kFloat32);
  EXPECT_EQ(out.schema.fields[0].type, ScalarType::kFloat32);
  EXPECT_EQ(out.schema.cell_data[0].type, ScalarType::kFloat64);
  ASSERT_EQ(out.vertexCount(), mesh.vertexCount());
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(out.position(v, i), static_cast<double>(static_cast<float>(mesh.position(v, i))));
      EXPECT_EQ(out.field(0, v, i), static_cast<double>(static_cast<float>(mesh.field(0, v, i))));
    }
  EXPECT_EQ(out.fields[1].bytes, mesh.fields[1].bytes);
  EXPECT_EQ(out.fields[2].bytes, mesh.fields[2].bytes);
  EXPECT_EQ(out.cell_data[0].bytes, mesh.cell_data[0].bytes);
  EXPECT_EQ(out.cells, mesh.cells);
}

TEST(RoundingSource, RoundsPositionsAndFieldsAndNothingElse) {
  const TestMesh mesh = doubleMesh();
  for (size_t batch : {size_t{1}, size_t{1000}}) {
    Cut cut;
    cut.batch_cells = batch;
    cut.say_box = true;
    MeshStream stream(mesh, cut);
    RoundingSource rounding(stream);
    for (size_t i = 0; i < 6; ++i)
      EXPECT_EQ(rounding.schema().box_min[i],
                static_cast<double>(static_cast<float>(stream.schema().box_min[i])));
    EXPECT_EQ(rounding.schema().box_max[6 + 1], stream.schema().box_max[6 + 1]);  // integers
    Recorder out;
    copyStream(rounding, out);
    EXPECT_EQ(out.problem, "");
    expectRounded(mesh, out.mesh);
  }
}

TEST(RoundingIndexedSource, GivesTheSame) {
  TestMesh mesh = doubleMesh();
  MemorySource memory(mesh.schema, mesh.view());
  RoundingIndexedSource source(memory);
  TestMesh out = mesh;
  out.schema = source.schema();
  const size_t n = mesh.vertexCount();
  out.positions.bytes.resize(n * 12);
  source.readPositions(0, 5, out.positions.bytes.data());
  source.readPositions(5, n - 5, out.positions.bytes.data() + 5 * 12);
  out.fields[0].bytes.resize(n * 12);
  for (size_t f = 0; f < 3; ++f) source.readField(f, 0, n, out.fields[f].bytes.data());
  source.readCells(0, mesh.cellCount(), out.cells.data());
  source.readCellData(0, 0, mesh.cellCount(), out.cell_data[0].bytes.data());
  expectRounded(mesh, out);
}

TEST(Rounding, IsNeededForFloat64Only) {
  Schema s = mixedSchema();
  EXPECT_TRUE(Rounding::needed(s));
  s.position_type = ScalarType::kFloat32;
  EXPECT_TRUE(Rounding::needed(s));
  s.fields[0].type = ScalarType::kFloat32;
  EXPECT_FALSE(Rounding::needed(s));
}

TEST(Rounding, RefusesWhatIsTooLargeAndNamesIt) {
  TestMesh mesh = doubleMesh();
  mesh.setField(0, 20, 1e39, 1);
  MeshStream stream(mesh, {});
  RoundingSource rounding(stream);
  Recorder out;
  try {
    copyStream(rounding, out);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kUnsupported);
    EXPECT_NE(error.text().find("vertex 20"), std::string::npos) << error.text();
    EXPECT_NE(error.text().find("of d"), std::string::npos) << error.text();
  }
}

TEST(CopyStream, HandsEveryBatchOn) {
  const TestMesh mesh = doubleMesh();
  Cut cut;
  cut.batch_cells = 10;
  cut.empty_batches = true;
  MeshStream stream(mesh, cut);
  Recorder out;
  copyStream(stream, out);
  EXPECT_TRUE(out.finished);
  EXPECT_EQ(out.problem, "");
  EXPECT_TRUE(out.exact_finalization);
  EXPECT_EQ(out.mesh.cells, mesh.cells);
  EXPECT_EQ(out.mesh.positions.bytes, mesh.positions.bytes);
}

}  // namespace
}  // namespace tetstream::test
