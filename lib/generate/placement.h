// generate: where the lattice's vertices stand. Depends on lattice.h and arithmetic.h.
#pragma once

#include <cstdint>

#include "lattice.h"

namespace tetstream {

// Up to kVertices vertices (first, b, c), (first + 1, b, c), ... of one line along x.
struct VertexRun {
  static constexpr int kVertices = 128;
  int64_t first = 0, b = 0, c = 0;
  int count = 0;
};

struct Positions {
  float x[VertexRun::kVertices], y[VertexRun::kVertices], z[VertexRun::kVertices];
};

// [0,1] x [0,1] x [0, depth / side]: each vertex is moved by at most 0.15 of the spacing along each
// axis, on the box's boundary only along it. Six times a cell's volume is then at least
// 1 - 6 * 0.15 = 0.1 of a cube's: it is linear in each of the cell's twelve numbers, so that its
// least value is taken at one of the 2^12 extreme choices.
void placeInBox(const Lattice& lattice, uint64_t seed, const VertexRun& run, Positions* out);

// The unit ball, side = depth even: the cube [-1,1]^3, inner vertices moved by at most 0.12 of the
// spacing along each axis, then each concentric cube blown up into a sphere. The map has creases
// where two of |x|, |y|, |z| are equal; with cubes split along diagonals that point away from the
// centre, faces of cells lie in them, and no cell has all vertices or two faces on the boundary.
// Six times a cell's volume is at least 0.05 of a cube's for all side (0.06 by search for the
// worst displacement of each cell's vertices).
void placeInBall(const Lattice& lattice, uint64_t seed, const VertexRun& run, Positions* out);

}  // namespace tetstream
