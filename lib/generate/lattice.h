// generate: the lattice of cubes that both meshes are made of, and its vertices' ranks. Depends on
// nothing.
//
// Cubes are streamed with x running fastest, then y, then z. A vertex is introduced by the first
// cube that has it. Cube row (j, k) introduces the lines (b, c) of vertices along x with
// b = j + 1, also b = 0 if j = 0, and c = k + 1, also c = 0 if k = 0: one, two or four lines,
// whose vertices come interleaved, all of a = 0 first, then all of a = 1, ... Hence a vertex's
// rank is a formula and nothing needs to be remembered.
#pragma once

#include <cstdint>

namespace tetstream {

struct Lattice {
  int64_t side = 0;   // cubes along x and y
  int64_t depth = 0;  // cubes along z

  int64_t vertexCount() const { return (side + 1) * (side + 1) * (depth + 1); }
  int64_t cubeCount() const { return side * side * depth; }
  // A number of a vertex's own, whatever the order: random numbers depend on it.
  uint64_t vertexNumber(int64_t a, int64_t b, int64_t c) const {
    return static_cast<uint64_t>((c * (side + 1) + b) * (side + 1) + a);
  }
};

// A line of vertices along x; vertex a has rank first_rank + a * stride.
struct VertexLine {
  int64_t first_rank, stride;
};

inline VertexLine lineAt(const Lattice& lattice, int64_t b, int64_t c) {
  const int64_t rows = b < 2 ? 2 : 1, layers = c < 2 ? 2 : 1;  // introduced together
  const int64_t lines_before = (c < 2 ? 0 : c * (lattice.side + 1)) + (b < 2 ? 0 : b * layers);
  const int64_t among = (c < 2 ? c * rows : 0) + (b < 2 ? b : 0);
  return {lines_before * (lattice.side + 1) + among, rows * layers};
}

}  // namespace tetstream
