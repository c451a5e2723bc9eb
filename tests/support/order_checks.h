// tests/support: what the tests of orders share.
#pragma once

#include <set>
#include <vector>

#include "connectivity.h"
#include "order_front.h"
#include "test_mesh.h"

namespace tetstream::test {

// A mesh as the orders see it, with its own account.
struct OrderMesh {
  explicit OrderMesh(const TestMesh& mesh);
  Account account;
  Connectivity connectivity{account};
  std::vector<double> places;  // [vertices][3]
};

// Vertices that share a cell, the obvious way.
std::vector<std::set<uint32_t>> neighboursOf(const Connectivity& mesh);

// The front of the stream that comes of ranks, the obvious way.
OrderFront plainFront(const Connectivity& mesh, const std::vector<uint32_t>& rank);

bool isPermutation(const Array<uint32_t>& rank);

// Whether the ranks of each component follow each other.
bool componentsAreConsecutive(const Connectivity& mesh, const Array<uint32_t>& rank);

// Meshes on which an order must not fail: nothing, unused vertices, one cell, the same cell twice,
// a cell that names a vertex twice, parts that touch at a vertex, many parts.
std::vector<TestMesh> oddMeshes();

// rank[v]: how many vertices lie before v along the axis; equal places go by vertex number.
void rankAlong(const OrderMesh& mesh, int axis, Array<uint32_t>& rank);

}  // namespace tetstream::test
