// tests: an indexed mesh as an ordered stream, and what holds for every such stream.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "front_meter.h"
#include "memory_source.h"
#include "ordered_source.h"
#include "shapes.h"

namespace tetstream::test {

// A source that is cheap in sequence only, so that values are spooled. Counts how often it is
// asked.
class SequentialSource final : public IndexedSource {
 public:
  explicit SequentialSource(IndexedSource& in) : in_(in) {}
  const Schema& schema() const override { return in_.schema(); }
  const uint8_t* locked() const override { return in_.locked(); }
  void readPositions(uint64_t first, size_t count, void* out) override {
    ++reads;
    in_.readPositions(first, count, out);
  }
  void readField(size_t column, uint64_t first, size_t count, void* out) override {
    ++reads;
    in_.readField(column, first, count, out);
  }
  void readCells(uint64_t first, size_t count, int64_t* out) override {
    ++reads;
    in_.readCells(first, count, out);
  }
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    ++reads;
    in_.readCellData(column, first, count, out);
  }
  size_t reads = 0;

 private:
  IndexedSource& in_;
};

// Every type of column, and ids to know vertices and cells again.
inline TestMesh withColumns(TestMesh mesh) {
  mesh.addIntegerField("vertex", [](size_t v) { return static_cast<int64_t>(v) + 100; });
  addPositionField(mesh, {"f", 1, ScalarType::kFloat32},
                   [](double x, double y, double z) { return x * y - z; });
  addPositionField(mesh, {"t", 9, ScalarType::kFloat64},
                   [](double x, double y, double z) { return x + 0.1 * y * z; });
  mesh.addIntegerCellData("cell", [](size_t c) { return static_cast<int64_t>(c) - 50; });
  mesh.addCellData({"d", 2, ScalarType::kFloat32},
                   [](size_t c, int i) { return static_cast<double>(c % 91) + i; });
  for (size_t v = 0; v < mesh.vertexCount(); ++v) mesh.locked.push_back(v % 11 == 3);
  return mesh;
}

inline void expectSameRow(const Rows& a, size_t i, const Rows& b, size_t j, size_t bytes) {
  ASSERT_LE((i + 1) * bytes, a.bytes.size());
  ASSERT_LE((j + 1) * bytes, b.bytes.size());
  EXPECT_EQ(0, std::memcmp(a.bytes.data() + i * bytes, b.bytes.data() + j * bytes, bytes));
}

// The stream's vertices and cells are those of the mesh, found by their ids, bit by bit.
inline void expectSameMesh(const TestMesh& mesh, const TestMesh& out) {
  ASSERT_EQ(out.cellCount(), mesh.cellCount());
  std::map<int64_t, size_t> vertices, cells;
  for (size_t v = 0; v < mesh.vertexCount(); ++v) vertices[mesh.fieldInteger(0, v)] = v;
  for (size_t c = 0; c < mesh.cellCount(); ++c) cells[mesh.cellInteger(0, c)] = c;
  std::vector<size_t> old_vertex;
  for (size_t v = 0; v < out.vertexCount(); ++v) {
    ASSERT_TRUE(vertices.count(out.fieldInteger(0, v)));
    old_vertex.push_back(vertices[out.fieldInteger(0, v)]);
    vertices.erase(out.fieldInteger(0, v));  // each once
    expectSameRow(mesh.positions, old_vertex[v], out.positions, v,
                  3 * sizeOf(mesh.schema.position_type));
    for (size_t f = 0; f < mesh.fields.size(); ++f)
      expectSameRow(mesh.fields[f], old_vertex[v], out.fields[f], v,
                    mesh.schema.fields[f].bytesPerRow());
    EXPECT_EQ(out.locked[v] != 0, !mesh.locked.empty() && mesh.locked[old_vertex[v]] != 0);
  }
  for (size_t c = 0; c < out.cellCount(); ++c) {
    ASSERT_TRUE(cells.count(out.cellInteger(0, c)));
    const size_t old = cells[out.cellInteger(0, c)];
    cells.erase(out.cellInteger(0, c));
    for (size_t j = 0; j < 4; ++j)  // the corners' order, too
      EXPECT_EQ(old_vertex[static_cast<size_t>(out.cells[4 * c + j])],
                static_cast<size_t>(mesh.cells[4 * old + j]));
    for (size_t k = 0; k < mesh.cell_data.size(); ++k)
      expectSameRow(mesh.cell_data[k], old, out.cell_data[k], c,
                    mesh.schema.cell_data[k].bytesPerRow());
  }
}

// The schema's counts, front and box are those of what was emitted.
inline void expectTruthful(const Schema& schema, const TestMesh& out,
                           const FrontStatistics& front) {
  EXPECT_EQ(schema.vertex_count, static_cast<int64_t>(out.vertexCount()));
  EXPECT_EQ(schema.cell_count, static_cast<int64_t>(out.cellCount()));
  EXPECT_EQ(schema.front_width, front.width);
  EXPECT_EQ(schema.front_span, front.span);
  EXPECT_EQ(schema.front_cells, front.cells);
  if (out.vertexCount() == 0) {
    EXPECT_FALSE(schema.hasBox());
    return;
  }
  ASSERT_TRUE(schema.hasBox());
  for (size_t i = 0; i < 3; ++i) {
    double low = out.position(0, static_cast<int>(i)), high = low;
    for (size_t v = 0; v < out.vertexCount(); ++v) {
      low = std::min(low, out.position(v, static_cast<int>(i)));
      high = std::max(high, out.position(v, static_cast<int>(i)));
    }
    EXPECT_EQ(schema.box_min[i], low) << "axis " << i;
    EXPECT_EQ(schema.box_max[i], high) << "axis " << i;
  }
  size_t at = 3;
  for (size_t f = 0; f < out.fields.size(); ++f)
    for (int k = 0; k < out.schema.fields[f].components; ++k, ++at) {
      double low = out.field(f, 0, k), high = low;
      for (size_t v = 0; v < out.vertexCount(); ++v) {
        low = std::min(low, out.field(f, v, k));
        high = std::max(high, out.field(f, v, k));
      }
      EXPECT_EQ(schema.box_min[at], low) << "field " << f;
      EXPECT_EQ(schema.box_max[at], high) << "field " << f;
    }
}

struct Ordered {
  Recorder out;
  Schema schema;
  FrontStatistics front;
  std::string chosen;
  int64_t unused = 0;
  uint64_t disk = 0;
};

inline Ordered ordered(TestMesh mesh, const OrderOptions& options, bool spooled) {
  Ordered result;
  MemorySource memory(mesh.schema, mesh.view());
  SequentialSource sequential(memory);
  OrderedSource source(spooled ? static_cast<IndexedSource&>(sequential) : memory, options);
  const size_t reads = sequential.reads;
  result.schema = source.schema();
  result.chosen = source.chosen();
  result.unused = source.unusedVertices();
  result.disk = source.diskBytes();
  Account account;
  FrontMeter meter(account);
  result.out.begin(source.schema());
  BatchView batch;
  while (source.next(batch)) {
    meter.put(batch);
    result.out.put(batch);
  }
  EXPECT_FALSE(source.next(batch));  // and again
  EXPECT_EQ(sequential.reads, reads) << "values were not spooled";
  result.out.finish();
  result.front = meter.statistics();
  return result;
}

inline OrderOptions inOrder(const std::string& order, size_t memory_bytes = 0) {
  OrderOptions options;
  options.order = order;
  options.memory_bytes = memory_bytes;
  return options;
}

inline Ordered ordered(const TestMesh& mesh, const std::string& axis, bool spooled) {
  OrderOptions options;
  options.axis = axis;
  return ordered(mesh, options, spooled);
}

inline void expectSound(const TestMesh& mesh, const Ordered& result) {
  EXPECT_EQ(result.out.problem, "");
  EXPECT_TRUE(result.out.exact_finalization);
  EXPECT_TRUE(result.out.compact);
  expectSameMesh(mesh, result.out.mesh);
  expectTruthful(result.schema, result.out.mesh, result.front);
}

}  // namespace tetstream::test
