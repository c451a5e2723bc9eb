// tests/support: where the boundary of a mesh passes through itself, or lies on itself, by brute
// force.
#pragma once

#include "test_mesh.h"

namespace tetstream::test {

// Pairs of faces on the boundary of which one has an edge that passes through the other, decided
// exactly; an edge that ends at a corner of the face does not.
int64_t crossingPairs(const TestMesh& mesh);

// Edges of the boundary between two faces that lie on each other, but for a degree.
int64_t foldedEdges(const TestMesh& mesh);

}  // namespace tetstream::test
