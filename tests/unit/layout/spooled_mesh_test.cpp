// A mesh that comes in batches, and is read as an indexed one.
#include "spooled_mesh.h"

#include <gtest/gtest.h>

#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

TestMesh withThreeColumns(TestMesh mesh) {
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
  const int n = slowRun() ? 4 : 20;  // beyond the memory, where time allows
  TestMesh mesh = inStreamOrder(withThreeColumns(fullGrid(n, n, n, 0.1)));
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
  TestMesh mesh = withThreeColumns(fullGrid(2, 2, 2));
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

// Faces keep their labels; what is locked of them, and edges, lock their vertices, also those of
// batches before.
TEST(SpooledMesh, KeepsFacesAndLocks) {
  TestMesh mesh = oneCell();
  mesh.locked.clear();
  SpooledMesh spooled(mesh.schema, "");
  BatchView batch = mesh.view();
  const int64_t faces[6] = {0, 1, 2, 2, 1, 3}, labels[2] = {5, -6}, edge[2] = {3, 0};
  const uint8_t none[2] = {0, 0}, second[2] = {0, 1};
  batch.face_count = 1;
  batch.faces = faces;
  batch.face_labels = labels;
  batch.face_locks = none;
  spooled.put(batch);
  BatchView late;
  late.first_vertex = mesh.vertexCount();
  late.face_count = 1;
  late.faces = faces + 3;
  late.face_labels = labels + 1;
  late.face_locks = second + 1;
  spooled.put(late);
  late.face_count = 0;
  late.edge_count = 1;
  late.locked_edges = edge;
  const int64_t unknown[2] = {0, 4};
  BatchView bad = late;
  bad.locked_edges = unknown;
  SpooledMesh other(mesh.schema, "");
  EXPECT_THROW(other.put(bad), Error);
  {
    SpooledMesh faces_only(mesh.schema, "");
    BatchView all = mesh.view();
    all.face_count = 2;
    all.faces = faces;
    all.face_labels = labels;
    all.face_locks = second;
    faces_only.put(all);
    faces_only.finish();
    ASSERT_NE(faces_only.locked(), nullptr);
    for (size_t v = 0; v < 4; ++v) EXPECT_EQ(faces_only.locked()[v], v != 0);
  }
  spooled.put(late);
  spooled.finish();
  EXPECT_EQ(spooled.schema().face_count, 2);
  int64_t corners[6], values[2];
  spooled.readFaces(0, 2, corners, values);
  EXPECT_TRUE(std::equal(corners, corners + 6, faces));
  EXPECT_TRUE(std::equal(values, values + 2, labels));
  for (size_t v = 0; v < 4; ++v) EXPECT_TRUE(spooled.locked()[v]);
}

}  // namespace
}  // namespace tetstream::test
