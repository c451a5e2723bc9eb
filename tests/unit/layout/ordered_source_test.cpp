// An indexed mesh as a stream: the same mesh, in a coherent order, with its front told exactly.
#include "ordered_source.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <map>

#include "front_meter.h"
#include "memory_source.h"
#include "shapes.h"
#include "status.h"

namespace tetstream::test {
namespace {

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
TestMesh withColumns(TestMesh mesh) {
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

void expectSameRow(const Rows& a, size_t i, const Rows& b, size_t j, size_t bytes) {
  ASSERT_LE((i + 1) * bytes, a.bytes.size());
  ASSERT_LE((j + 1) * bytes, b.bytes.size());
  EXPECT_EQ(0, std::memcmp(a.bytes.data() + i * bytes, b.bytes.data() + j * bytes, bytes));
}

// The stream's vertices and cells are those of the mesh, found by their ids, bit by bit.
void expectSameMesh(const TestMesh& mesh, const TestMesh& out) {
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
void expectTruthful(const Schema& schema, const TestMesh& out, const FrontStatistics& front) {
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

Ordered ordered(TestMesh mesh, const OrderOptions& options, bool spooled) {
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

OrderOptions inOrder(const std::string& order, size_t memory_bytes = 0) {
  OrderOptions options;
  options.order = order;
  options.memory_bytes = memory_bytes;
  return options;
}

Ordered ordered(const TestMesh& mesh, const std::string& axis, bool spooled) {
  OrderOptions options;
  options.axis = axis;
  return ordered(mesh, options, spooled);
}

void expectSound(const TestMesh& mesh, const Ordered& result) {
  EXPECT_EQ(result.out.problem, "");
  EXPECT_TRUE(result.out.exact_finalization);
  EXPECT_TRUE(result.out.compact);
  expectSameMesh(mesh, result.out.mesh);
  expectTruthful(result.schema, result.out.mesh, result.front);
}

constexpr const char* kOrders[] = {"auto", "none", "spatial", "brick", "z-order", "hilbert"};

// In memory, in runs, and with points in several parts.
void expectOrdered(const TestMesh& mesh) {
  for (bool spooled : {false, true}) {
    for (const char* axis : {"x", "y", "z"}) {
      SCOPED_TRACE(std::string(axis) + (spooled ? ", spooled" : ""));
      expectSound(mesh, ordered(mesh, axis, spooled));
    }
    for (const char* order : kOrders) {
      SCOPED_TRACE(std::string(order) + (spooled ? ", spooled" : ""));
      const Ordered result = ordered(mesh, inOrder(order), spooled);
      expectSound(mesh, result);
      const Ordered small = ordered(mesh, inOrder(order, 1), spooled);
      EXPECT_TRUE(small.out.allBytes() == result.out.allBytes());
    }
  }
}

TEST(OrderedSource, GivesTheSameMesh) {
  expectOrdered(withColumns(shuffled(fullGrid(3, 4, 5, 0.1), 3)));
  expectOrdered(withColumns(shuffled(fullGrid(3, 3, 3, 0, ScalarType::kFloat32), 4)));
  expectOrdered(withColumns(shuffled(ringGrid(5), 5)));
  expectOrdered(withColumns(oneCell()));
}

TEST(OrderedSource, GivesTheSameMeshWithoutAnyColumns) {
  TestMesh mesh = shuffled(fullGrid(3, 3, 3), 8);
  for (bool spooled : {false, true}) {
    const Ordered result = ordered(mesh, "auto", spooled);
    EXPECT_EQ(result.out.problem, "");
    EXPECT_EQ(result.out.mesh.cellCount(), mesh.cellCount());
    EXPECT_EQ(result.out.mesh.vertexCount(), mesh.vertexCount());
  }
}

Recorder recorded(Source& source) {
  Recorder out;
  out.begin(source.schema());
  BatchView batch;
  while (source.next(batch)) out.put(batch);
  EXPECT_FALSE(source.next(batch));
  out.finish();
  return out;
}

// To its end, or a batch only; the same events then as without.
TEST(OrderedSource, CanBeReadAgain) {
  const int n = slowRun() ? 4 : 12;  // several batches
  TestMesh mesh = withColumns(shuffled(fullGrid(n, n, n, 0.1), 7));
  for (bool spooled : {false, true}) {
    const Ordered once = ordered(mesh, "auto", spooled);
    MemorySource memory(mesh.schema, mesh.view());
    SequentialSource sequential(memory);
    OrderedSource source(spooled ? static_cast<IndexedSource&>(sequential) : memory, {});
    {
      const std::unique_ptr<Source> second = source.again();
      ASSERT_NE(second, nullptr);
      EXPECT_EQ(second->schema().front_cells, source.schema().front_cells);
      EXPECT_TRUE(recorded(*second).allBytes() == once.out.allBytes());
    }
    {
      const std::unique_ptr<Source> second = source.again();
      BatchView batch;
      EXPECT_TRUE(second->next(batch));
    }
    const Recorder first = recorded(source);
    EXPECT_EQ(first.problem, "");
    EXPECT_TRUE(first.allBytes() == once.out.allBytes());
  }
}

// Larger than what is read and spooled at once.
TEST(OrderedSource, GivesTheSameLargeMesh) {
  if (slowRun()) return;
  const TestMesh mesh = withColumns(shuffled(fullGrid(26, 26, 26, 0.1), 6));
  ASSERT_GT(mesh.vertexCount(), 16384u);
  for (const char* order : kOrders) {
    SCOPED_TRACE(order);
    const Ordered result = ordered(mesh, inOrder(order, 1 << 18), true);
    EXPECT_GT(result.out.batches, 10u);
    EXPECT_GT(result.disk, size_t{1} << 20);
    expectSound(mesh, result);
  }
}

TEST(OrderedSource, SweepsAlongTheNarrowestFront) {
  EXPECT_EQ(ordered(shuffled(fullGrid(12, 3, 3), 1), "auto", false).chosen, "spatial, along x");
  EXPECT_EQ(ordered(shuffled(fullGrid(3, 12, 3), 1), "auto", false).chosen, "spatial, along y");
  EXPECT_EQ(ordered(shuffled(fullGrid(3, 3, 12), 1), "auto", false).chosen, "spatial, along z");
  const TestMesh mesh = shuffled(fullGrid(3, 4, 8), 2);
  const int64_t best = ordered(mesh, "auto", false).front.cells;
  for (const char* axis : {"x", "y", "z"}) {
    const Ordered result = ordered(mesh, axis, false);
    EXPECT_EQ(result.chosen, "spatial, along " + std::string(axis));
    EXPECT_GE(result.front.cells, best);
  }
  // A layer of 3 x 4 x 6 = 72 cells, and the next one half begun.
  EXPECT_LT(best, 3 * 72);
}

// Turned, a long box is swept along it as it was before, not along an axis.
TEST(OrderedSource, SweepsAlongATiltedDirection) {
  const TestMesh box = fullGrid(6, 6, 40, 0.2);
  std::vector<double> turned;
  for (size_t v = 0; v < box.vertexCount(); ++v) {
    const double x = box.position(v, 0), z = box.position(v, 2);
    const double c = std::cos(0.7), s = std::sin(0.7);
    turned.insert(turned.end(), {c * x - s * z, box.position(v, 1), c * z + s * x});
  }
  const TestMesh mesh = shuffled(makeMesh(ScalarType::kFloat64, turned, box.cells), 3);
  const Ordered result = ordered(mesh, "auto", false);
  EXPECT_EQ(result.chosen.find("spatial, along ("), 0u) << result.chosen;
  const Ordered straight = ordered(box, "auto", false);
  EXPECT_LE(result.front.width, straight.front.width + straight.front.width / 10);
  for (const char* axis : {"x", "y", "z"})
    EXPECT_GT(ordered(mesh, axis, false).front.width, result.front.width + 6) << axis;
}

TEST(OrderedSource, RanksByTheGraph) {
  const TestMesh mesh = withColumns(shuffled(fullGrid(4, 5, 9, 0.1), 3));
  const int64_t swept = ordered(mesh, inOrder("spatial"), true).front.width;
  for (const char* order : {"breadth-first", "spectral"})
    for (bool spooled : {false, true}) {
      SCOPED_TRACE(order);
      const Ordered result = ordered(mesh, inOrder(order), spooled);
      expectSound(mesh, result);
      EXPECT_EQ(result.chosen, order);
      EXPECT_LE(result.front.width, swept + swept / 2);
      if (order[0] == 'b') {
        EXPECT_LE(result.front.span, result.front.width * 3 / 2);
      }
    }
}

// A layer has more cells than a piece.
TEST(OrderedSource, RanksBreadthFirstThroughWideFronts) {
  const int n = slowRun() ? 27 : 40;
  const TestMesh mesh = withColumns(shuffled(fullGrid(n, n, 3), 3));
  OrderOptions options = inOrder("breadth-first", 1);
  options.axis = "z";
  expectSound(mesh, ordered(mesh, options, true));
}

// Boxes whose numbers overflow, or are next to nothing, in some direction.
TEST(OrderedSource, OrdersBoxesOfExtremeSizes) {
  const TestMesh grid = fullGrid(3, 3, 3);
  for (double size : {1e308, 0x1p1000, 1e-310, 0.0}) {
    std::vector<double> places;
    for (size_t v = 0; v < grid.vertexCount(); ++v)
      for (int i = 0; i < 3; ++i) {
        const double at = grid.position(v, i) - 1.5;
        places.push_back(i == 2 ? at / 1.5 * size : at);
      }
    TestMesh mesh = makeMesh(ScalarType::kFloat64, places, grid.cells);
    mesh.addIntegerField("vertex", [](size_t v) { return static_cast<int64_t>(v); });
    mesh.addIntegerCellData("cell", [](size_t c) { return static_cast<int64_t>(c); });
    for (const char* order : kOrders) expectSound(mesh, ordered(mesh, inOrder(order), true));
  }
}

// Where the graph does not fit the memory: clusters of some vertices, still narrower than a curve.
TEST(OrderedSource, RanksSpectrallyByClusters) {
  const int n = slowRun() ? 6 : 12;
  TestMesh mesh = withColumns(shuffled(fullGrid(n, n, 3 * n, 0.1), 3));
  const Ordered result = ordered(mesh, inOrder("spectral", 1 << 18), true);
  EXPECT_EQ(result.chosen, "spectral, by clusters");
  expectSound(mesh, result);
  const int64_t swept = ordered(mesh, inOrder("spatial"), true).front.width;
  EXPECT_LE(result.front.width, 2 * swept);
  EXPECT_LE(result.front.width, ordered(mesh, inOrder("hilbert"), true).front.width);
  EXPECT_TRUE(ordered(mesh, inOrder("spectral", 1 << 18), false).out.allBytes() ==
              result.out.allBytes());
  for (const TestMesh& odd : {withColumns(apart(3)), withColumns(oneCell())})
    expectSound(odd, ordered(odd, inOrder("spectral", 1), true));
}

// Pieces of 4096 cells; several parts, points that are not used, the same whatever the source.
TEST(OrderedSource, RanksBreadthFirstPieceByPiece) {
  const int n = slowRun() ? 8 : 14;
  TestMesh mesh = withColumns(shuffled(fullGrid(n, n, 2 * n, 0.1), 3));
  const Ordered result = ordered(mesh, inOrder("breadth-first", 1), true);
  EXPECT_EQ(result.chosen, "breadth-first, piece by piece");
  expectSound(mesh, result);
  const Ordered swept = ordered(mesh, inOrder("spatial"), true);
  EXPECT_LE(result.front.width, 2 * swept.front.width);
  EXPECT_TRUE(ordered(mesh, inOrder("breadth-first", 1), false).out.allBytes() ==
              result.out.allBytes());
  expectSound(withColumns(apart(3)),
              ordered(withColumns(apart(3)), inOrder("breadth-first", 1), true));
}

// Cells as they are in the mesh.
TEST(OrderedSource, LeavesCellsWhereTheyAre) {
  const TestMesh mesh = withColumns(shuffled(fullGrid(3, 3, 3), 2));
  const Ordered result = ordered(mesh, inOrder("none"), true);
  for (size_t c = 0; c < mesh.cellCount(); ++c)
    EXPECT_EQ(result.out.mesh.cellInteger(0, c), mesh.cellInteger(0, c));
}

TEST(OrderedSource, RefusesOrdersThatThereAreNot) {
  const TestMesh mesh = fullGrid(2, 2, 2);
  try {
    ordered(mesh, inOrder("zigzag"), false);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::kBadArgument);
    EXPECT_NE(std::string(error.text()).find("hilbert"), std::string::npos) << error.text();
  }
}

TEST(OrderedSource, ComesAlongTheAxis) {
  const Ordered result = ordered(shuffled(fullGrid(4, 4, 4), 3), "y", false);
  double highest = -1;
  for (size_t c = 0; c < result.out.mesh.cellCount(); ++c) {
    double last = 0;  // a cell comes with its last vertex
    for (size_t j = 0; j < 4; ++j)
      last = std::max(
          last, result.out.mesh.position(static_cast<size_t>(result.out.mesh.cells[4 * c + j]), 1));
    EXPECT_GE(last, highest);
    highest = last;
  }
}

// Far from the origin and in any unit the order is the same: places count relative to the box.
TEST(OrderedSource, DoesNotDependOnUnitOrPlace) {
  const TestMesh mesh = shuffled(fullGrid(3, 3, 6), 3);
  const auto cells = ordered(mesh, "z", false).out.mesh.cells;
  for (double unit : {0x1p-300, 0x1p300, 0x1p-20})
    for (double offset : {0.0, 1e6}) {
      std::vector<double> positions;
      for (size_t v = 0; v < mesh.vertexCount(); ++v)
        for (int i = 0; i < 3; ++i) positions.push_back(unit * (mesh.position(v, i) + offset));
      EXPECT_TRUE(ordered(makeMesh(ScalarType::kFloat64, positions, mesh.cells), "z", false)
                      .out.mesh.cells == cells);
    }
}

// Points that no cell uses are left out: of the stream, of its counts and of its box, whatever
// values they have.
TEST(OrderedSource, LeavesUnusedPointsOut) {
  TestMesh mesh = makeMesh(ScalarType::kFloat64,
                           {-50, 0, 0, 0, 0, 0, 1, 0, 0, 0, 90, 0, 0, 1, 0, 0, 0, 1}, {1, 2, 4, 5});
  mesh = withColumns(mesh);
  for (bool spooled : {false, true}) {
    const Ordered result = ordered(mesh, "auto", spooled);
    EXPECT_EQ(result.unused, 2);
    EXPECT_EQ(result.out.mesh.vertexCount(), 4u);
    expectSameMesh(mesh, result.out.mesh);
    expectTruthful(result.schema, result.out.mesh, result.front);
  }
}

// What an unused point holds must not reach the sweep, NaN least of all.
TEST(OrderedSource, IsNotDisturbedByUnusedPoints) {
  const TestMesh mesh = fullGrid(3, 3, 12);
  const Ordered plain = ordered(mesh, "auto", false);
  for (double value : {0.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    // An unused point before each used one.
    std::vector<double> points;
    std::vector<int64_t> cells;
    for (size_t v = 0; v < mesh.vertexCount(); ++v) {
      points.insert(points.end(), {value, value, value});
      for (int axis = 0; axis < 3; ++axis) points.push_back(mesh.position(v, axis));
    }
    for (int64_t corner : mesh.cells) cells.push_back(2 * corner + 1);
    const Ordered result = ordered(makeMesh(ScalarType::kFloat64, points, cells), "auto", true);
    EXPECT_EQ(result.schema.front_cells, plain.schema.front_cells) << value;
    EXPECT_EQ(result.schema.box_max, plain.schema.box_max) << value;
    EXPECT_TRUE(result.out.mesh.cells == plain.out.mesh.cells) << value;
  }
}

TEST(OrderedSource, TakesMeshesWithoutCellsOrPoints) {
  const TestMesh none = makeMesh(ScalarType::kFloat32, {}, {});
  const TestMesh points = makeMesh(ScalarType::kFloat32, {0, 0, 0, 1, 2, 3}, {});
  for (bool spooled : {false, true}) {
    EXPECT_EQ(ordered(none, "auto", spooled).out.batches, 0u);
    const Ordered result = ordered(points, "auto", spooled);
    EXPECT_EQ(result.unused, 2);
    EXPECT_EQ(result.schema.vertex_count, 0);
  }
}

std::string refusalOf(const std::function<void(TestMesh&)>& damage, bool spooled, Status wanted,
                      const std::string& axis = "auto") {
  TestMesh mesh = withColumns(fullGrid(2, 2, 2));
  damage(mesh);
  try {
    ordered(mesh, axis, spooled);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), wanted);
    return error.text();
  }
  return "";
}

TEST(OrderedSource, NamesBadIds) {
  for (bool spooled : {false, true})
    for (int64_t bad : {int64_t{27}, int64_t{-1}, int64_t{1} << 32, int64_t{1} << 62}) {
      const std::string text =
          refusalOf([bad](TestMesh& m) { m.cells[4 * 5 + 2] = bad; }, spooled, Status::kBadData);
      EXPECT_NE(text.find("cell 5"), std::string::npos) << text;
      EXPECT_NE(text.find(std::to_string(bad)), std::string::npos) << text;
    }
}

TEST(OrderedSource, NamesValuesThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (bool spooled : {false, true}) {
    EXPECT_NE(refusalOf([nan](TestMesh& m) { m.setField(2, 7, nan, 8); }, spooled, Status::kBadData)
                  .find("point 7: its t"),
              std::string::npos);
    EXPECT_NE(refusalOf(
                  [nan](TestMesh& m) {
                    std::memcpy(m.positions.bytes.data() + (3 * 9 + 1) * 8, &nan, 8);
                  },
                  spooled, Status::kBadData)
                  .find("point 9: its position"),
              std::string::npos);
  }
}

TEST(OrderedSource, RefusesAxesThatThereAreNot) {
  EXPECT_NE(refusalOf([](TestMesh&) {}, false, Status::kBadArgument, "w").find("\"w\""),
            std::string::npos);
  EXPECT_NE(refusalOf([](TestMesh&) {}, false, Status::kBadArgument, "xy"), "");
}

TEST(OrderedSource, TellsHowFarItIsAndCanBeStopped) {
  TestMesh mesh = withColumns(fullGrid(2, 2, 2));
  MemorySource memory(mesh.schema, mesh.view());
  OrderOptions options;
  std::vector<double> told;
  options.tell = [&](double fraction) { told.push_back(fraction); };
  OrderedSource whole(memory, options);
  ASSERT_GT(told.size(), 3u);
  for (size_t i = 1; i < told.size(); ++i) EXPECT_GE(told[i], told[i - 1]);
  EXPECT_LE(told.back(), 1);
  for (size_t stop = 0; stop < told.size(); ++stop) {
    size_t calls = 0;
    options.tell = [&](double) {
      if (calls++ == stop) fail(Status::kCancelled, "enough");
    };
    EXPECT_THROW(OrderedSource(memory, options), Error);
  }
}

}  // namespace
}  // namespace tetstream::test
