// layout/graph: the breadth-first order of a mesh's vertices. Depends on order_front.h,
// vertex_graph.h.
#pragma once

#include <functional>

#include "connectivity.h"

namespace tetstream {

// Ranks vertices as Vo et al. 2007, section 3.2, do: the next one is a neighbour of (1) the oldest
// vertex of the queue whose neighbours are not all taken, (2) preferably one that completes a cell,
// (3) the one that was met last. Starts at vertices far from each other, on the boundary where
// there are such, and keeps the start with the least span. Components come one after the other.
// `tell` is called now and then and may throw. About 25 bytes a cell and 100 a vertex.
void orderBreadthFirst(const Connectivity& mesh, Account& account,
                       const std::function<void()>& tell, Array<uint32_t>& rank);

}  // namespace tetstream
