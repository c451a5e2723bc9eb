// layout: orders that follow from which vertices share cells, for meshes that fit the memory.
// Depends on mesh_reading.h, orders.h.
#pragma once

#include "memory.h"
#include "mesh_reading.h"
#include "orders.h"

namespace tetstream {

// What ranking such a mesh takes, about. `order`: breadth-first or spectral.
uint64_t graphOrderBytes(Order order, uint64_t points, uint64_t cells);

// rank[v]: the place of point v in the order. The mesh is read once.
void rankByGraph(IndexedSource& source, Order order, Account& account, const Tell& tell,
                 Array<uint32_t>& rank);

}  // namespace tetstream
