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
struct OrderWidths {
  int64_t spectral, by_place;
};
OrderWidths rankNarrowest(IndexedSource& source, const VertexKey& key, Account& account,
                          const Tell& tell, Array<uint32_t>& rank);

}  // namespace tetstream
