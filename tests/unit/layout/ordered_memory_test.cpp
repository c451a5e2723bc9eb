// What ordering takes of memory: what it was given, whatever the size of the mesh.
#include "ordered_testing.h"

namespace tetstream::test {
namespace {

// A few bits of each point and cell are beside the budget: which points are used, and last.
size_t bitsBeside(const TestMesh& mesh) {
  return mesh.vertexCount() / 2 + mesh.cellCount() / 8;
}

TEST(OrderedMemory, IsKeptInEachOrderByPlace) {
  const int n = slowRun() ? 16 : 24;
  const size_t memory = slowRun() ? 160 << 10 : 512 << 10;
  TestMesh mesh = withColumns(shuffled(fullGrid(n, n, n, 0.1), 7));
  const char* const orders[] = {"spatial", "brick", "z-order", "hilbert"};
  for (size_t i = 0; i < std::size(orders); i += oneIn(2)) {
    const char* order = orders[i];
    SCOPED_TRACE(order);
    MemorySource in(mesh.schema, mesh.view());
    SequentialSource sequential(in);
    const OrderedSource free(sequential, inOrder(order));
    const OrderedSource bounded(sequential, inOrder(order, memory));
    EXPECT_GT(free.peakBytes(), 3 * memory) << "the mesh is too small to tell";
    EXPECT_LE(bounded.peakBytes(), memory + memory / 8 + bitsBeside(mesh));
  }
}

}  // namespace
}  // namespace tetstream::test
