// A mesh that comes in batches, and is read as an indexed one.
#include "spooled_mesh.h"

#include <gtest/gtest.h>

#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

TestMesh withColumns(TestMesh mesh) {
  addPositionField(mesh, {"f", 2, ScalarType::kFloat64},
                   [](double x, double y, double z) { return x * y - z; });
  mesh.addIntegerField("n", [](size_t v) { return static_cast<int64_t>(v) * 3; });
  mesh.addIntegerCellData("id", [](size_t c) { return static_cast<int64_t>(c) - 7; });
  return mesh;
}

// Row by row, in pieces that do not fit the blocks.
void expectSame(const TestMesh& mesh, IndexedSource& source) {
  const size_t vertices = mesh.vertexCount(), cells = mesh.cellCount();
  ASSERT_EQ(source.schema().vertex_count, static_cast<int64_t>(vertices));
  ASSERT_EQ(source.schema().cell_count, static_cast<int64_t>(cells));
  double position[3 * 7], f[2 * 7];
  int64_t n[7], corners[4 * 7], id[7];
  for (size_t at = 0; at < vertices; at += 7) {
    const size_t count = std::min<size_t>(7, vertices - at);
    source.readPositions(at, count, position);
    source.readField(0, at, count, f);
    source.readField(1, at, count, n);
    for (size_t i = 0; i < count; ++i) {
      EXPECT_EQ(position[3 * i + 2], mesh.position(at + i, 2));
      EXPECT_EQ(f[2 * i + 1], mesh.field(0, at + i, 1));
      EXPECT_EQ(n[i], mesh.fieldInteger(1, at + i));
    }
  }
  for (size_t at = 0; at < cells; at += 7) {
    const size_t count = std::min<size_t>(7, cells - at);
    source.readCells(at, count, corners);
    source.readCellData(0, at, count, id);
    for (size_t i = 0; i < 4 * count; ++i) EXPECT_EQ(corners[i], mesh.cells[4 * at + i]);
    for (size_t i = 0; i < count; ++i) EXPECT_EQ(id[i], mesh.cellInteger(0, at + i));
  }
}

TEST(SpooledMesh, GivesAStreamBack) {
  const int n = slowRun() ? 4 : 16;  // beyond the memory, where time allows
  TestMesh mesh = inStreamOrder(withColumns(fullGrid(n, n, n, 0.1)));
  for (size_t batch : {size_t{100}, size_t{100000}}) {
    Cut cut;
    cut.batch_cells = batch;
    cut.empty_batches = true;
    MeshStream stream(mesh, cut);
    double told = 0;
    const auto spooled = spoolStream(stream, "", [&](double share) {
      EXPECT_GE(share, told);
      told = share;
    });
    EXPECT_EQ(told, cut.say_counts ? 1 : told);
    expectSame(mesh, *spooled);
    EXPECT_EQ(spooled->locked(), nullptr);
    EXPECT_EQ(spooled->diskBytes() > 0, !slowRun());
  }
}

// Vertex by vertex, then all cells; one of them is locked, in the middle.
TEST(SpooledMesh, PutsBatchesTogetherWithTheirLocks) {
  TestMesh mesh = withColumns(fullGrid(2, 2, 2));
  SpooledMesh spooled(mesh.schema, "");
  const BatchView all = mesh.view();
  const uint8_t locked = 1;
  for (size_t v = 0; v < mesh.vertexCount(); ++v) {
    const auto row = [v](const void* rows, size_t bytes) {
      return static_cast<const unsigned char*>(rows) + v * bytes;
    };
    const void* const fields[2] = {row(all.fields[0], 16), row(all.fields[1], 8)};
    BatchView part;
    part.first_vertex = v;
    part.vertex_count = 1;
    part.positions = row(all.positions, 24);
    part.fields = fields;
    part.locked = v == 3 ? &locked : nullptr;
    spooled.put(part);
  }
  BatchView cells = all;
  cells.vertex_count = 0;
  cells.positions = nullptr;
  cells.fields = nullptr;
  spooled.put(cells);
  spooled.finish();
  expectSame(mesh, spooled);
  ASSERT_NE(spooled.locked(), nullptr);
  for (size_t v = 0; v < mesh.vertexCount(); ++v) EXPECT_EQ(spooled.locked()[v], v == 3);
}

TEST(SpooledMesh, RefusesFaces) {
  TestMesh mesh = oneCell();
  SpooledMesh spooled(mesh.schema, "");
  BatchView batch = mesh.view();
  const int64_t face[3] = {0, 1, 2}, label = 5;
  batch.face_count = 1;
  batch.faces = face;
  batch.face_labels = &label;
  EXPECT_THROW(spooled.put(batch), Error);
}

}  // namespace
}  // namespace tetstream::test
