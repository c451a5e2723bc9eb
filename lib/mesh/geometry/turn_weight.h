// mesh/geometry: numbers by which a sum tells whether the triangles round a vertex close a circle.
// Depends on nothing.
#pragma once

#include <cstdint>

namespace tetstream {

// Looks random, and is another for each vertex. Of the directed edges b c, c d, ... round a vertex
// the weight of each end less that of each beginning sums up to 0 where they close a circle, and
// otherwise to the difference of two weights: not 0. Of several fans it is 0 by a chance of about
// 2^-60.
inline uint64_t turnWeight(uint32_t vertex) {
  const uint64_t x = vertex * uint64_t{0x9e3779b97f4a7c15};
  return x ^ (x >> 32);
}

}  // namespace tetstream
