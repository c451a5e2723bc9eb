// layout: orders that follow from which vertices share cells, for meshes that fit the memory.
// Depends on ranked_vertices.h, orders.h.
#pragma once

#include "orders.h"
#include "ranked_vertices.h"

namespace tetstream {

// What ranking such a mesh takes, about. `order`: breadth-first or spectral.
uint64_t graphOrderBytes(Order order, uint64_t points, uint64_t cells);

// rank[v]: the place of point v in the order. The mesh is read once.
void rankByGraph(IndexedSource& source, Order order, Account& account, const Tell& tell,
                 Array<uint32_t>& rank);

// The narrower of the spectral order and that of keys from places: front widths, in vertices.
// Spectral ones are not tried, kUntried, where hardly anything could be gained.
struct OrderWidths {
  static constexpr int64_t kUntried = -1;
  int64_t by_place = 0, spectral = kUntried;
};
OrderWidths rankNarrowest(IndexedSource& source, const VertexKey& key, Account& account,
                          const Tell& tell, Array<uint32_t>& rank);

}  // namespace tetstream
