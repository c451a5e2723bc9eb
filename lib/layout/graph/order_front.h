// layout/graph: the stream that comes of ranked vertices, and its front. Depends on connectivity.h.
//
// A cell comes right after its vertex of highest rank, cells of equal rank by number; a vertex is
// introduced just before the first cell that uses it and finalized with the last.
#pragma once

#include "connectivity.h"

namespace tetstream {

constexpr uint32_t kUnused = 0xffffffffu;

struct OrderFront {
  int64_t front_cells = 0;  // cells read that touch a vertex not yet finalized, at most
  int64_t front_width = 0;  // vertices introduced and not finalized, at most
  int64_t front_span = 0;   // highest minus lowest such vertex + 1, at most
  double mean_width = 0;    // over the cells
};

struct StreamOrder : OrderFront {
  explicit StreamOrder(Account& account) : cell_at(account), rank(account), last_use(account) {}
  Array<uint32_t> cell_at;   // which cell comes at each place
  Array<uint32_t> rank;      // of each vertex: how many others are used before it; kUnused: never
  Array<uint32_t> last_use;  // of each vertex: the place of the last cell that uses it
  uint32_t used_vertices = 0;
};

// `order.rank` holds the ranks, each below the number of vertices, and takes those of the stream.
// Takes 8 bytes a cell and 12 a vertex, of which 4 a cell and 8 a vertex stay.
void makeStream(const Connectivity& mesh, Account& account, StreamOrder& order);

// The stream of cells that already have their places: `order.cell_at` holds them. Memory as above.
void followCells(const Connectivity& mesh, Account& account, StreamOrder& order);

// The figures alone, of the stream that comes of ranks.
OrderFront frontOfRanks(const Connectivity& mesh, const Array<uint32_t>& rank, Account& account);

}  // namespace tetstream
