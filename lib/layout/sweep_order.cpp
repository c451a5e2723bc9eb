#include "sweep_order.h"

#include <algorithm>
#include <numeric>

namespace tetstream {

void rankAlong(const Connectivity& mesh, int axis, Account& account, Array<uint32_t>& rank) {
  const float* place = mesh.places.data() + static_cast<size_t>(axis) * mesh.vertices;
  Array<uint32_t> order(account, mesh.vertices);
  std::iota(order.data(), order.data() + mesh.vertices, 0u);
  std::sort(order.data(), order.data() + mesh.vertices, [place](uint32_t a, uint32_t b) {
    return place[a] != place[b] ? place[a] < place[b] : a < b;
  });
  for (uint32_t i = 0; i < mesh.vertices; ++i) rank[order[i]] = i;
}

void orderBySweep(const Connectivity& mesh, int axis, Account& account,
                  const std::function<void()>& tell, SweepOrder& order) {
  order.rank.resize(mesh.vertices);
  order.axis = std::max(axis, 0);
  if (axis < 0) {
    int64_t narrowest = -1;
    for (int candidate = 0; candidate < 3; ++candidate) {
      tell();
      rankAlong(mesh, candidate, account, order.rank);
      const int64_t front = frontOfRanks(mesh, order.rank, account).front_cells;
      if (narrowest >= 0 && front >= narrowest) continue;
      narrowest = front;
      order.axis = candidate;
    }
  }
  tell();
  rankAlong(mesh, order.axis, account, order.rank);
  tell();
  makeStream(mesh, account, order);
}

}  // namespace tetstream
