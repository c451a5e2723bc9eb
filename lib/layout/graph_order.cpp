#include "graph_order.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "breadth_first.h"
#include "order_front.h"
#include "spectral.h"
#include "status.h"
#include "vertex_graph.h"

namespace tetstream {

// Of the orders' own arrays and the mesh's corners; measured on real meshes.
struct GraphBytes {
  uint64_t point, cell;
};
constexpr GraphBytes kBreadthFirst = {100, 66}, kSpectral = {400, 32};

uint64_t graphOrderBytes(Order order, uint64_t points, uint64_t cells) {
  if (cells > kMostCells) return std::numeric_limits<uint64_t>::max();
  const GraphBytes bytes = order == Order::kSpectral ? kSpectral : kBreadthFirst;
  return bytes.point * points + bytes.cell * cells;
}

static void readMesh(IndexedSource& source, const Tell& tell, Connectivity& mesh) {
  const int64_t points = source.schema().vertex_count, cells = source.schema().cell_count;
  mesh.vertices = static_cast<uint32_t>(points);
  mesh.cells = static_cast<uint32_t>(cells);
  mesh.corners.resize(4 * static_cast<size_t>(cells));
  readAllCells(source, tell, [&](uint64_t first, size_t count, const int64_t* corners) {
    for (size_t i = 0; i < 4 * count; ++i)
      mesh.corners[4 * static_cast<size_t>(first) + i] = static_cast<uint32_t>(corners[i]);
  });
}

// How many steps there will be is not known: ever smaller ones towards the end.
static std::function<void()> stepsOf(const Tell& tell) {
  return [&tell, done = 0.0]() mutable { tell(done += (1 - done) / 16); };
}

void rankByGraph(IndexedSource& source, Order order, Account& account, const Tell& tell,
                 Array<uint32_t>& rank) {
  Connectivity mesh(account);
  readMesh(
      source, [&](double share) { tell(0.1 * share); }, mesh);
  const Tell rest = [&](double share) { tell(0.1 + 0.9 * share); };
  if (order == Order::kSpectral)
    orderSpectral(mesh, account, stepsOf(rest), rank);
  else
    orderBreadthFirst(mesh, account, stepsOf(rest), rank);
}

static void rankByKeys(IndexedSource& source, const VertexKey& key, Account& account,
                       Array<uint32_t>& rank) {
  const auto points = static_cast<size_t>(source.schema().vertex_count);
  const ScalarType type = source.schema().position_type;
  Array<uint64_t> keys(account, points);
  std::vector<double> rows(3 * std::min(kRowsOfPiece, points));
  readInPieces(
      points, [](double) {},
      [&](uint64_t first, size_t count) {
        source.readPositions(first, count, rows.data());
        for (size_t i = 0; i < count; ++i) {
          double place[3];
          placeAt(rows.data(), type, i, place);
          keys[static_cast<size_t>(first) + i] = key(first + i, place);
        }
      });
  Array<uint32_t> order(account, points);
  std::iota(order.data(), order.data() + points, 0u);
  std::sort(order.data(), order.data() + points, [&keys](uint32_t a, uint32_t b) {
    return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
  });
  rank.resize(points);
  for (uint32_t i = 0; i < points; ++i) rank[order[i]] = i;
}

// Vertices. A cell alone has 4, so that no order can do much better, and nothing that holds a front
// would notice. Of meshes so thin and long the spectral order is the dearest: 8 s for a chain of
// 200,000 cells.
constexpr int64_t kNarrowEnough = 16;

OrderWidths rankNarrowest(IndexedSource& source, const VertexKey& key, Account& account,
                          const Tell& tell, Array<uint32_t>& rank) {
  Connectivity mesh(account);
  readMesh(
      source, [&](double share) { tell(0.1 * share); }, mesh);
  OrderWidths widths;
  rankByKeys(source, key, account, rank);
  widths.by_place = frontOfRanks(mesh, rank, account).front_width;
  if (widths.by_place <= kNarrowEnough) return widths;
  tell(0.15);
  const Tell rest = [&](double share) { tell(0.15 + 0.8 * share); };
  Array<uint32_t> spectral(account);
  orderSpectral(mesh, account, stepsOf(rest), spectral);
  widths.spectral = frontOfRanks(mesh, spectral, account).front_width;
  if (widths.spectral < widths.by_place) rank.swap(spectral);
  return widths;
}

}  // namespace tetstream
