// An indexed mesh as a stream: the same mesh, in a coherent order, with its front told exactly.
#include <algorithm>
#include <array>
#include <cmath>

#include "ordered_testing.h"
#include "status.h"

namespace tetstream::test {
namespace {

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
      const std::unique_ptr<Source> second = source.again(Part::kAll);
      ASSERT_NE(second, nullptr);
      EXPECT_EQ(second->schema().front_cells, source.schema().front_cells);
      EXPECT_TRUE(recorded(*second).allBytes() == once.out.allBytes());
    }
    {
      const std::unique_ptr<Source> second = source.again(Part::kAll);
      BatchView batch;
      EXPECT_TRUE(second->next(batch));
    }
    const Recorder first = recorded(source);
    EXPECT_EQ(first.problem, "");
    EXPECT_TRUE(first.allBytes() == once.out.allBytes());
  }
}

// Each vertex once, and nothing else.
TEST(OrderedSource, TellsPlacesAlone) {
  const int n = slowRun() ? 4 : 18;  // several batches
  TestMesh mesh = shuffled(fullGrid(n, n, n, 0.1), 7);
  MemorySource memory(mesh.schema, mesh.view());
  OrderedSource source(memory, {});
  const auto sorted = [](Source& in) {
    std::vector<std::array<double, 3>> places;
    BatchView batch;
    while (in.next(batch))
      for (size_t row = 0; row < batch.vertex_count; ++row) {
        const double* place = static_cast<const double*>(batch.positions) + 3 * row;
        places.push_back({place[0], place[1], place[2]});
      }
    std::sort(places.begin(), places.end());
    return places;
  };
  const std::unique_ptr<Source> alone = source.again(Part::kPositions);
  ASSERT_NE(alone, nullptr);
  const auto places = sorted(*alone);
  EXPECT_EQ(places.size(), mesh.vertexCount());
  EXPECT_TRUE(places == sorted(source));
  EXPECT_TRUE(sorted(*alone).empty());
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

// Of a slab, and of a column of single cubes: a spectral order takes long for such, if they are
// long.
TEST(OrderedSource, SeeksTheNarrowestUnlessTheSweepIsNarrowEnough) {
  OrderOptions options = inOrder("auto");
  options.narrowest = true;
  const TestMesh slab = withColumns(shuffled(fullGrid(2, 5, 9, 0.1), 3));
  const TestMesh chain = withColumns(shuffled(fullGrid(1, 1, 40), 3));
  for (bool spooled : {false, true}) {
    const Ordered sought = ordered(slab, options, spooled),
                  narrow = ordered(chain, options, spooled);
    expectSound(slab, sought);
    EXPECT_NE(sought.chosen.find("spectral"), std::string::npos) << sought.chosen;
    EXPECT_NE(sought.chosen.find(" has "), std::string::npos) << sought.chosen;
    expectSound(chain, narrow);
    EXPECT_LE(narrow.front.width, 16);
    EXPECT_EQ(narrow.chosen, "spatial, along z, with a front of " +
                                 std::to_string(narrow.front.width) + " vertices");
    EXPECT_TRUE(narrow.out.allBytes() == ordered(chain, inOrder("auto"), spooled).out.allBytes());
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

}  // namespace
}  // namespace tetstream::test
