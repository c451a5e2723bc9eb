// layout: the order of an indexed mesh's cells along an axis. Depends on order_front.h.
//
// Spatial sort (Vo et al. 2007, section 3.2): vertices are ranked along the axis, a cell comes with
// its last vertex. Holds the connectivity in memory: 24 bytes a cell, 24 a vertex at most.
#pragma once

#include <functional>

#include "order_front.h"

namespace tetstream {

struct SweepOrder : StreamOrder {
  using StreamOrder::StreamOrder;
  int axis = 0;
};

// rank[v]: how many vertices lie before v along the axis; equal places go by vertex number.
void rankAlong(const Connectivity& mesh, int axis, Account& account, Array<uint32_t>& rank);

// Sweeps along `axis` (0, 1, 2), or, if it is negative, along the one with the fewest cells in the
// front. `tell` is called now and then and may throw.
void orderBySweep(const Connectivity& mesh, int axis, Account& account,
                  const std::function<void()>& tell, SweepOrder& order);

}  // namespace tetstream
