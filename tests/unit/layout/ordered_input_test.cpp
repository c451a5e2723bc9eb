// What of an indexed mesh is left out of its stream or refused, and how far its ordering is.
#include <cmath>
#include <functional>
#include <limits>

#include "ordered_testing.h"
#include "status.h"

namespace tetstream::test {
namespace {

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
  OrderOptions options;
  options.axis = axis;
  options.measured.assign(mesh.schema.fields.size(), true);
  try {
    ordered(mesh, options, spooled);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), wanted);
    return error.text();
  }
  return "";
}

// Somebody writes the file meanwhile: from the second reading on a cell has a point that no cell
// had, and that therefore has no place among the others.
class Rewritten final : public IndexedSource {
 public:
  Rewritten(IndexedSource& in, int64_t unused) : in_(in), unused_(unused) {}
  const Schema& schema() const override { return in_.schema(); }
  bool randomAccess() const override { return in_.randomAccess(); }
  void readPositions(uint64_t first, size_t count, void* out) override {
    in_.readPositions(first, count, out);
  }
  void readField(size_t column, uint64_t first, size_t count, void* out) override {
    in_.readField(column, first, count, out);
  }
  void readCells(uint64_t first, size_t count, int64_t* out) override {
    in_.readCells(first, count, out);
    if (first == 0 && readings_++ > 0) out[2] = unused_;
  }
  void readCellData(size_t column, uint64_t first, size_t count, void* out) override {
    in_.readCellData(column, first, count, out);
  }

 private:
  IndexedSource& in_;
  int64_t unused_;
  int readings_ = 0;
};

TEST(OrderedSource, RefusesCellsThatChangeWhileTheyAreRead) {
  TestMesh mesh =
      makeMesh(ScalarType::kFloat64, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 9, 9, 9},
               {0, 1, 2, 3, 1, 2, 3, 4});
  for (bool spooled : {false, true})
    for (const char* order : {"spatial", "none"})
      for (size_t memory_bytes : {0, 1}) {
        MemorySource memory(mesh.schema, mesh.view());
        SequentialSource sequential(memory);
        Rewritten source(spooled ? static_cast<IndexedSource&>(sequential) : memory, 5);
        try {
          OrderedSource ordered(source, inOrder(order, memory_bytes));
          ADD_FAILURE() << order << ", " << memory_bytes << (spooled ? ", spooled" : "");
        } catch (const Error& error) {
          EXPECT_EQ(error.status(), Status::kBadData);
          EXPECT_NE(error.text().find("changed"), std::string::npos) << error.text();
        }
      }
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

// Fields that nobody measures keep what they have; the box is of what is finite.
TEST(OrderedSource, CarriesValuesThatAreNotFinite) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  TestMesh mesh = withColumns(fullGrid(2, 2, 2));
  for (int i = 0; i < 9; ++i) mesh.setField(2, 7, i % 2 ? kInf : -kInf, i);
  mesh.setField(2, 7, std::numeric_limits<double>::quiet_NaN(), 8);
  for (bool spooled : {false, true}) {
    const Ordered result = ordered(mesh, OrderOptions(), spooled);
    const size_t at = result.schema.boxSize() - 9;
    for (size_t i = at; i < result.schema.boxSize(); ++i) {
      EXPECT_TRUE(std::isfinite(result.schema.box_min[i]));
      EXPECT_TRUE(std::isfinite(result.schema.box_max[i]));
    }
    size_t strange = 0;
    for (size_t v = 0; v < result.out.mesh.vertexCount(); ++v)
      for (int i = 0; i < 9; ++i) strange += !std::isfinite(result.out.mesh.field(2, v, i));
    EXPECT_EQ(strange, 9u);
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
