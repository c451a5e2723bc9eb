#include "vertex_graph.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "status.h"

namespace tetstream {

static bool isRepeated(const uint32_t* v, int j) {
  return std::find(v, v + j, v[j]) != v + j;
}

void listCells(const Connectivity& mesh, CellLists& lists) {
  if (mesh.cells > kMostCells)
    fail(Status::kUnsupported, "a mesh of %u cells: orders that follow its graph hold up to %u",
         mesh.cells, kMostCells);
  // One place further, so that filling moves each start to where it belongs.
  lists.first.resize(size_t{mesh.vertices} + 2);
  std::fill_n(lists.first.data(), lists.first.size(), 0u);
  for (uint32_t c = 0; c < mesh.cells; ++c)
    for (int j = 0; j < 4; ++j)
      if (!isRepeated(mesh.cell(c), j)) ++lists.first[size_t{mesh.cell(c)[j]} + 2];
  for (size_t i = 2; i < lists.first.size(); ++i) lists.first[i] += lists.first[i - 1];
  lists.cell.resize(lists.first[size_t{mesh.vertices} + 1]);
  for (uint32_t c = 0; c < mesh.cells; ++c)
    for (int j = 0; j < 4; ++j)
      if (!isRepeated(mesh.cell(c), j)) lists.cell[lists.first[size_t{mesh.cell(c)[j]} + 1]++] = c;
  lists.first.resize(size_t{mesh.vertices} + 1);
}

// Calls take(neighbour) for each neighbour of v once. seen[u] == v: u was met at v.
template <class Take>
static void forNeighbours(const Connectivity& mesh, const CellLists& lists, uint32_t v,
                          Array<uint32_t>& seen, Take take) {
  seen[v] = v;
  for (uint32_t i = lists.first[v]; i < lists.first[v + 1]; ++i) {
    const uint32_t* corners = mesh.cell(lists.cell[i]);
    for (int j = 0; j < 4; ++j) {
      if (seen[corners[j]] == v) continue;
      seen[corners[j]] = v;
      take(corners[j]);
    }
  }
}

void buildGraph(const Connectivity& mesh, const CellLists& lists, Account& account,
                VertexGraph& graph) {
  constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  graph.vertices = mesh.vertices;
  graph.first.resize(size_t{mesh.vertices} + 1);
  Array<uint32_t> seen(account, mesh.vertices);
  std::fill_n(seen.data(), mesh.vertices, kNone);
  uint64_t total = 0;
  for (uint32_t v = 0; v < mesh.vertices; ++v) {
    graph.first[v] = static_cast<uint32_t>(total);
    forNeighbours(mesh, lists, v, seen, [&](uint32_t) { ++total; });
  }
  if (total > kNone)
    fail(Status::kUnsupported, "a mesh with %llu edges: orders that follow its graph hold up to %u",
         static_cast<unsigned long long>(total / 2), kNone / 2);
  graph.first[mesh.vertices] = static_cast<uint32_t>(total);
  graph.neighbour.resize(total);
  std::fill_n(seen.data(), mesh.vertices, kNone);
  uint32_t* next = graph.neighbour.data();
  for (uint32_t v = 0; v < mesh.vertices; ++v)
    forNeighbours(mesh, lists, v, seen, [&](uint32_t u) { *next++ = u; });
}

uint32_t findComponents(const VertexGraph& graph, Account& account, Array<uint32_t>& member,
                        Array<uint32_t>& start) {
  member.resize(graph.vertices);
  start.resize(size_t{graph.vertices} + 1);
  uint32_t found = 0, end = 0;
  Array<uint8_t> reached(account, graph.vertices);
  std::fill_n(reached.data(), graph.vertices, uint8_t{0});
  for (uint32_t v = 0; v < graph.vertices; ++v) {
    if (reached[v]) continue;
    start[found++] = end;
    uint32_t at = end;
    reached[v] = 1;
    member[end++] = v;
    for (; at < end; ++at)
      for (const uint32_t* u = graph.begin(member[at]); u < graph.end(member[at]); ++u) {
        if (reached[*u]) continue;
        reached[*u] = 1;
        member[end++] = *u;
      }
  }
  start[found] = end;
  start.resize(size_t{found} + 1);
  return found;
}

// The faces of v's cells on which v is the lowest vertex, each as the other two, the lower one in
// the upper bits.
static void lowestFaces(const Connectivity& mesh, const CellLists& lists, uint32_t v,
                        std::vector<uint64_t>& faces) {
  faces.clear();
  for (uint32_t i = lists.first[v]; i < lists.first[v + 1]; ++i) {
    uint32_t sorted[4];
    std::copy_n(mesh.cell(lists.cell[i]), 4, sorted);
    std::sort(sorted, sorted + 4);
    const auto face = [&](int a, int b) { faces.push_back(uint64_t{sorted[a]} << 32 | sorted[b]); };
    if (sorted[0] == v) {
      face(1, 2);
      face(1, 3);
      face(2, 3);
    } else if (sorted[1] == v) {
      face(2, 3);
    }
  }
  std::sort(faces.begin(), faces.end());
}

void markBoundary(const Connectivity& mesh, const CellLists& lists, Array<uint8_t>& boundary) {
  boundary.resize(mesh.vertices);
  std::fill_n(boundary.data(), mesh.vertices, uint8_t{0});
  std::vector<uint64_t> faces;  // some dozens at most
  for (uint32_t v = 0; v < mesh.vertices; ++v) {
    lowestFaces(mesh, lists, v, faces);
    for (size_t i = 0, next = 0; i < faces.size(); i = next) {
      for (next = i + 1; next < faces.size() && faces[next] == faces[i]; ++next) {
      }
      if (next - i > 1) continue;
      boundary[v] = boundary[faces[i] >> 32] = boundary[faces[i] & 0xffffffffu] = 1;
    }
  }
}

}  // namespace tetstream
