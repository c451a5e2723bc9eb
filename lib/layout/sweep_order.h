// layout: the order of an indexed mesh's cells along an axis. Depends on base.
//
// Spatial sort (Vo et al. 2007, section 3.2): vertices are ranked along the axis, a cell comes with
// its last vertex. Holds the connectivity in memory: 24 bytes a cell, 24 a vertex at most.
#pragma once

#include <cstdint>
#include <functional>

#include "memory.h"

namespace tetstream {

// A mesh's connectivity and the places of its vertices, each along three axes in [0, 1].
struct Connectivity {
  explicit Connectivity(Account& account) : corners(account), places(account) {}
  uint32_t vertices = 0, cells = 0;
  Array<uint32_t> corners;  // [cells][4]
  Array<float> places;      // [3][vertices]
};

struct SweepOrder {
  explicit SweepOrder(Account& account) : cell_at(account), rank(account), last_use(account) {}
  int axis = 0;
  Array<uint32_t> cell_at;   // which cell comes at each place
  Array<uint32_t> rank;      // of each vertex: how many others are used before it; kUnused: never
  Array<uint32_t> last_use;  // of each vertex: the place of the last cell that uses it
  uint32_t used_vertices = 0;
  int64_t front_cells = 0, front_width = 0, front_span = 0;
};

constexpr uint32_t kUnused = 0xffffffffu;

// Sweeps along `axis` (0, 1, 2), or, if it is negative, along the one with the narrowest front.
// `tell` is called now and then and may throw.
void orderBySweep(const Connectivity& mesh, int axis, Account& account,
                  const std::function<void()>& tell, SweepOrder& order);

}  // namespace tetstream
