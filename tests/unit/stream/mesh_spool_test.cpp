// A mesh that is collected, outside of memory.
#include "mesh_spool.h"

#include <gtest/gtest.h>

#include <vector>

namespace tetstream {
namespace {

// What is locked may come early, in the first of many batches.
TEST(MeshSpool, KnowsOfEachPointWhetherItIsLocked) {
  constexpr size_t kPoints = 1000;
  { const std::vector<uint8_t> before(kPoints, 0xff); }  // memory that is not zero
  MeshSpool mesh(ScalarType::kFloat64, "");
  const std::vector<double> positions(3 * kPoints);
  mesh.appendPositions(positions.data(), 2);
  mesh.lock(1);
  mesh.appendPositions(positions.data(), kPoints - 2);
  mesh.finish();
  ASSERT_NE(mesh.locked(), nullptr);
  size_t locked = 0;
  for (size_t i = 0; i < kPoints; ++i) locked += mesh.locked()[i] != 0;
  EXPECT_EQ(locked, 1u);
  EXPECT_EQ(mesh.locked()[1], 1);
}

}  // namespace
}  // namespace tetstream
