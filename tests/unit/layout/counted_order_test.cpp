// Cells of a mesh in memory in the order of their last vertices. That the stream is the same as
// that of sorted records is for ordered_source_test.cpp.
#include "counted_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "memory_source.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

TEST(CountedCells, ComeByTheirHighestRank) {
  TestMesh mesh = makeMesh(ScalarType::kFloat64, std::vector<double>(18, 0.0),
                           {0, 1, 2, 3, 1, 2, 3, 4, 0, 1, 2, 3, 2, 3, 4, 5});
  MemorySource source(mesh.schema, mesh.view());
  Account account;
  Array<uint32_t> ranks(account, 6);
  for (uint32_t point = 0; point < 6; ++point) ranks[point] = 5 - point;
  // Highest ranks are 5, 4, 5, 3: cells 0 and 2 are equal and stay as they are.
  const CountedCells order(source, ranks, 6, account, [](double) {});
  ASSERT_EQ(order.count(), 4u);
  EXPECT_EQ(order[0], 3u);
  EXPECT_EQ(order[1], 1u);
  EXPECT_EQ(order[2], 0u);
  EXPECT_EQ(order[3], 2u);
}

TEST(CountedCells, TakeFourBytesACellAndFourAVertex) {
  TestMesh mesh = shuffled(fullGrid(9, 9, 9), 1);
  MemorySource source(mesh.schema, mesh.view());
  Account others, account;
  Array<uint32_t> ranks(others, mesh.vertexCount());
  for (size_t point = 0; point < mesh.vertexCount(); ++point)
    ranks[point] = static_cast<uint32_t>(point);
  const CountedCells order(source, ranks, mesh.vertexCount(), account, [](double) {});
  EXPECT_EQ(account.peak(), 4 * (mesh.cellCount() + mesh.vertexCount()));
  EXPECT_EQ(account.used(), 4 * mesh.cellCount());
}

TEST(CountedCells, ServeWhatFitsTheMemory) {
  TestMesh mesh = fullGrid(4, 4, 4);
  const MemorySource source(mesh.schema, mesh.view());
  const size_t bytes = 4 * (mesh.cellCount() + 2 * mesh.vertexCount() + 1);
  EXPECT_TRUE(CountedCells::serves(source, bytes));
  EXPECT_FALSE(CountedCells::serves(source, bytes - 1));
}

}  // namespace
}  // namespace tetstream::test
