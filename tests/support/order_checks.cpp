#include "order_checks.h"

#include <algorithm>
#include <numeric>

#include "shapes.h"

namespace tetstream::test {

OrderMesh::OrderMesh(const TestMesh& mesh) {
  Connectivity& to = connectivity;
  to.vertices = static_cast<uint32_t>(mesh.vertexCount());
  to.cells = static_cast<uint32_t>(mesh.cellCount());
  to.corners.resize(mesh.cells.size());
  for (size_t i = 0; i < mesh.cells.size(); ++i)
    to.corners[i] = static_cast<uint32_t>(mesh.cells[i]);
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int axis = 0; axis < 3; ++axis) places.push_back(mesh.position(v, axis));
}

std::vector<std::set<uint32_t>> neighboursOf(const Connectivity& mesh) {
  std::vector<std::set<uint32_t>> of(mesh.vertices);
  for (uint32_t c = 0; c < mesh.cells; ++c)
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if (mesh.cell(c)[i] != mesh.cell(c)[j]) of[mesh.cell(c)[i]].insert(mesh.cell(c)[j]);
  return of;
}

OrderFront plainFront(const Connectivity& mesh, const std::vector<uint32_t>& rank) {
  const auto last = [&](uint32_t c) {
    uint32_t most = 0;
    for (int j = 0; j < 4; ++j) most = std::max(most, rank[mesh.cell(c)[j]]);
    return most;
  };
  std::vector<uint32_t> order(mesh.cells), uses(mesh.vertices, 0), id(mesh.vertices, kUnused);
  for (uint32_t c = 0; c < mesh.cells; ++c) {
    order[c] = c;
    for (uint32_t v : std::set<uint32_t>(mesh.cell(c), mesh.cell(c) + 4)) ++uses[v];
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return last(a) < last(b); });
  OrderFront front;
  std::set<uint32_t> active;  // ids
  std::vector<uint32_t> read;
  uint32_t next = 0;
  double sum = 0;
  for (uint32_t c : order) {
    for (int j = 0; j < 4; ++j) {
      uint32_t& name = id[mesh.cell(c)[j]];
      if (name == kUnused) active.insert(name = next++);
    }
    const auto width = static_cast<int64_t>(active.size());
    front.front_width = std::max(front.front_width, width);
    front.front_span = std::max<int64_t>(front.front_span, *active.rbegin() - *active.begin() + 1);
    sum += static_cast<double>(width);
    for (uint32_t v : std::set<uint32_t>(mesh.cell(c), mesh.cell(c) + 4))
      if (--uses[v] == 0) active.erase(id[v]);
    read.push_back(c);
    read.erase(std::remove_if(read.begin(), read.end(),
                              [&](uint32_t r) {
                                return std::none_of(
                                    mesh.cell(r), mesh.cell(r) + 4,
                                    [&](uint32_t v) { return active.count(id[v]) > 0; });
                              }),
               read.end());
    front.front_cells = std::max(front.front_cells, static_cast<int64_t>(read.size()));
  }
  if (mesh.cells) front.mean_width = sum / mesh.cells;
  return front;
}

bool isPermutation(const Array<uint32_t>& rank) {
  std::vector<bool> seen(rank.size());
  for (size_t v = 0; v < rank.size(); ++v) {
    if (rank[v] >= rank.size() || seen[rank[v]]) return false;
    seen[rank[v]] = true;
  }
  return true;
}

bool componentsAreConsecutive(const Connectivity& mesh, const Array<uint32_t>& rank) {
  const auto neighbours = neighboursOf(mesh);
  std::vector<bool> seen(mesh.vertices);
  for (uint32_t v = 0; v < mesh.vertices; ++v) {
    if (seen[v]) continue;
    std::vector<uint32_t> members{v};
    seen[v] = true;
    uint32_t low = rank[v], high = rank[v];
    for (size_t at = 0; at < members.size(); ++at)
      for (uint32_t u : neighbours[members[at]]) {
        if (seen[u]) continue;
        seen[u] = true;
        members.push_back(u);
        low = std::min(low, rank[u]);
        high = std::max(high, rank[u]);
      }
    if (high - low + 1 != members.size()) return false;
  }
  return true;
}

static TestMesh withCells(const std::vector<int64_t>& cells, size_t vertices) {
  std::vector<double> positions(3 * vertices);
  for (size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<double>(i * i % 7);
  return makeMesh(ScalarType::kFloat64, positions, cells);
}

std::vector<TestMesh> oddMeshes() {
  std::vector<TestMesh> meshes{withCells({}, 0),
                               withCells({}, 5),
                               oneCell(),
                               withCells({4, 2, 7, 5}, 9),
                               withCells({0, 1, 2, 3, 3, 1, 0, 2}, 4),
                               withCells({0, 1, 1, 2, 2, 2, 2, 2, 3, 4, 5, 6}, 7),
                               cubesAtVertex(2),
                               cubesAtEdge(2),
                               apart(2),
                               slitGrid(4)};
  std::vector<int64_t> many;
  for (int64_t i = 0; i < 200; ++i) many.push_back(i * 37 % 200);
  meshes.push_back(withCells(many, 200));
  return meshes;
}

void rankAlong(const OrderMesh& mesh, int axis, Array<uint32_t>& rank) {
  std::vector<uint32_t> order(mesh.connectivity.vertices);
  std::iota(order.begin(), order.end(), 0u);
  const auto placeOf = [&](uint32_t v) { return mesh.places[3 * v + static_cast<size_t>(axis)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return placeOf(a) < placeOf(b); });
  for (uint32_t i = 0; i < order.size(); ++i) rank[order[i]] = i;
}

}  // namespace tetstream::test
