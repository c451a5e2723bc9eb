#include "graph_order.h"

#include <limits>

#include "breadth_first.h"
#include "connectivity.h"
#include "spectral.h"
#include "status.h"

namespace tetstream {

// Of the orders' own arrays and the mesh's corners; measured on real meshes.
struct GraphBytes {
  uint64_t point, cell;
};
constexpr GraphBytes kBreadthFirst = {100, 66}, kSpectral = {400, 32};

uint64_t graphOrderBytes(Order order, uint64_t points, uint64_t cells) {
  const GraphBytes bytes = order == Order::kSpectral ? kSpectral : kBreadthFirst;
  return bytes.point * points + bytes.cell * cells;
}

void rankByGraph(IndexedSource& source, Order order, Account& account, const Tell& tell,
                 Array<uint32_t>& rank) {
  const int64_t points = source.schema().vertex_count, cells = source.schema().cell_count;
  if (cells > std::numeric_limits<int32_t>::max() / 2)
    fail(Status::kUnsupported, "order \"%s\": %lld cells are too many", nameOf(order),
         static_cast<long long>(cells));
  Connectivity mesh(account);
  mesh.vertices = static_cast<uint32_t>(points);
  mesh.cells = static_cast<uint32_t>(cells);
  mesh.corners.resize(4 * static_cast<size_t>(cells));
  readAllCells(
      source, [&](double share) { tell(0.1 * share); },
      [&](uint64_t first, size_t count, const int64_t* corners) {
        for (size_t i = 0; i < 4 * count; ++i)
          mesh.corners[4 * static_cast<size_t>(first) + i] = static_cast<uint32_t>(corners[i]);
      });
  // How many steps there will be is not known: ever smaller ones towards the end.
  double done = 0.1;
  const auto step = [&] { tell(done += (1 - done) / 16); };
  if (order == Order::kSpectral)
    orderSpectral(mesh, account, step, rank);
  else
    orderBreadthFirst(mesh, account, step, rank);
}

}  // namespace tetstream
