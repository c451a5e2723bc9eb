#include "sweep_order.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace tetstream {

namespace {

// rank[v]: how many vertices lie before v along the axis; equal places go by vertex number.
void rankAlong(const Connectivity& mesh, int axis, Array<uint32_t>& scratch,
               Array<uint32_t>& rank) {
  const float* place = mesh.places.data() + static_cast<size_t>(axis) * mesh.vertices;
  uint32_t* order = scratch.data();
  std::iota(order, order + mesh.vertices, 0u);
  std::sort(order, order + mesh.vertices, [place](uint32_t a, uint32_t b) {
    return place[a] != place[b] ? place[a] < place[b] : a < b;
  });
  for (uint32_t i = 0; i < mesh.vertices; ++i) rank[order[i]] = i;
}

uint32_t lastRank(const Connectivity& mesh, uint32_t cell, const Array<uint32_t>& rank) {
  const uint32_t* v = mesh.corners.data() + 4 * size_t{cell};
  return std::max({rank[v[0]], rank[v[1]], rank[v[2]], rank[v[3]]});
}

// The front of the sweep: a cell comes at its last vertex's rank and stays until the last cell of
// any of its vertices has come.
int64_t frontOf(const Connectivity& mesh, const Array<uint32_t>& rank, Array<uint32_t>& final_at,
                Array<int32_t>& change) {
  std::fill_n(final_at.data(), mesh.vertices, 0u);
  std::memset(change.data(), 0, change.size() * sizeof(int32_t));
  for (uint32_t c = 0; c < mesh.cells; ++c) {
    const uint32_t last = lastRank(mesh, c, rank);
    for (int j = 0; j < 4; ++j) {
      uint32_t& f = final_at[mesh.corners[4 * size_t{c} + static_cast<size_t>(j)]];
      f = std::max(f, last);
    }
  }
  for (uint32_t c = 0; c < mesh.cells; ++c) {
    const uint32_t* v = mesh.corners.data() + 4 * size_t{c};
    ++change[lastRank(mesh, c, rank)];
    --change[std::max({final_at[v[0]], final_at[v[1]], final_at[v[2]], final_at[v[3]]})];
  }
  int64_t front = 0, widest = 0;
  for (size_t i = 0; i < change.size(); ++i) widest = std::max(widest, front += change[i]);
  return widest;
}

// Cells by the rank of their last vertex, equal ones by number: a counting sort.
void sortCells(const Connectivity& mesh, const Array<uint32_t>& rank, Array<uint32_t>& start,
               Array<uint32_t>& cell_at) {
  std::fill_n(start.data(), size_t{mesh.vertices} + 1, 0u);
  for (uint32_t c = 0; c < mesh.cells; ++c) ++start[lastRank(mesh, c, rank) + 1];
  for (uint32_t i = 0; i < mesh.vertices; ++i) start[i + 1] += start[i];
  for (uint32_t c = 0; c < mesh.cells; ++c) cell_at[start[lastRank(mesh, c, rank)]++] = c;
}

// Ranks of the stream: vertices in the order of their first use.
void rankByUse(const Connectivity& mesh, SweepOrder& order) {
  std::fill_n(order.rank.data(), mesh.vertices, kUnused);
  for (uint32_t place = 0; place < mesh.cells; ++place)
    for (size_t j = 0; j < 4; ++j) {
      const uint32_t v = mesh.corners[4 * size_t{order.cell_at[place]} + j];
      if (order.rank[v] == kUnused) order.rank[v] = order.used_vertices++;
      order.last_use[v] = place;
    }
}

// Exact figures of the front, by walking through the order once.
void measureFront(const Connectivity& mesh, Account& account, SweepOrder& order) {
  Array<int32_t> leave(account, size_t{mesh.cells} + 1);
  Array<uint32_t> last_of_rank(account, std::max(order.used_vertices, 1u));
  std::memset(leave.data(), 0, leave.size() * sizeof(int32_t));
  for (uint32_t v = 0; v < mesh.vertices; ++v)
    if (order.rank[v] != kUnused) last_of_rank[order.rank[v]] = order.last_use[v];
  for (uint32_t c = 0; c < mesh.cells; ++c) {
    const uint32_t* v = mesh.corners.data() + 4 * size_t{c};
    ++leave[std::max(
        {order.last_use[v[0]], order.last_use[v[1]], order.last_use[v[2]], order.last_use[v[3]]})];
  }
  int64_t cells = 0, active = 0;
  uint32_t introduced = 0, oldest = 0;
  for (uint32_t place = 0; place < mesh.cells; ++place) {
    const uint32_t* v = mesh.corners.data() + 4 * size_t{order.cell_at[place]};
    for (int j = 0; j < 4; ++j) {
      if (order.rank[v[j]] < introduced) continue;
      introduced = order.rank[v[j]] + 1;
      ++active;
    }
    order.front_width = std::max(order.front_width, active);
    order.front_span = std::max<int64_t>(order.front_span, introduced - oldest);
    for (int j = 0; j < 4; ++j) active -= order.last_use[v[j]] == place;
    while (oldest < introduced && last_of_rank[oldest] <= place) ++oldest;
    cells += 1 - leave[place];
    order.front_cells = std::max(order.front_cells, cells);
  }
}

}  // namespace

void orderBySweep(const Connectivity& mesh, int axis, Account& account,
                  const std::function<void()>& tell, SweepOrder& order) {
  order.rank.resize(mesh.vertices);
  order.last_use.resize(mesh.vertices);
  Array<uint32_t> scratch(account, size_t{mesh.vertices} + 1);
  order.axis = std::max(axis, 0);
  if (axis < 0) {
    Array<int32_t> change(account, std::max(mesh.vertices, 1u));
    int64_t narrowest = -1;
    for (int candidate = 0; candidate < 3; ++candidate) {
      tell();
      rankAlong(mesh, candidate, scratch, order.rank);
      const int64_t front = frontOf(mesh, order.rank, scratch, change);
      if (narrowest >= 0 && front >= narrowest) continue;
      narrowest = front;
      order.axis = candidate;
    }
  }
  tell();
  rankAlong(mesh, order.axis, scratch, order.rank);
  order.cell_at.resize(mesh.cells);
  sortCells(mesh, order.rank, scratch, order.cell_at);
  tell();
  rankByUse(mesh, order);
  measureFront(mesh, account, order);
}

}  // namespace tetstream
