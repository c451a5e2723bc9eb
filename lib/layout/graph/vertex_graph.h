// layout/graph: which vertices and cells of a mesh meet. Depends on connectivity.h.
#pragma once

#include "connectivity.h"

namespace tetstream {

// The cells of each vertex, ascending; a cell that names a vertex twice stands in its list once.
struct CellLists {
  explicit CellLists(Account& account) : first(account), cell(account) {}
  Array<uint32_t> first;  // [vertices + 1]
  Array<uint32_t> cell;   // of vertex v: [first[v], first[v + 1])
};

// Lists are numbered with 32 bits.
constexpr uint32_t kMostCells = (1u << 30) - 1;

// Throws kUnsupported above kMostCells.
void listCells(const Connectivity& mesh, CellLists& lists);

// Vertices that share a cell, each neighbour once, nobody its own; the lists are not sorted.
struct VertexGraph {
  explicit VertexGraph(Account& account) : first(account), neighbour(account) {}
  uint32_t vertices = 0;
  Array<uint32_t> first;      // [vertices + 1]
  Array<uint32_t> neighbour;  // of vertex v: [first[v], first[v + 1])
  uint32_t degree(uint32_t v) const { return first[v + 1] - first[v]; }
  const uint32_t* begin(uint32_t v) const { return neighbour.data() + first[v]; }
  const uint32_t* end(uint32_t v) const { return neighbour.data() + first[v + 1]; }
};

void buildGraph(const Connectivity& mesh, const CellLists& lists, Account& account,
                VertexGraph& graph);

// Components one after the other, by their lowest vertex; a vertex without neighbours is one of its
// own. `member` takes the vertices, component by component, each in the order of a breadth-first
// search; component i has [start[i], start[i + 1]). Returns how many there are.
uint32_t findComponents(const VertexGraph& graph, Account& account, Array<uint32_t>& member,
                        Array<uint32_t>& start);

// boundary[v]: whether v is on a face that only one cell has.
void markBoundary(const Connectivity& mesh, const CellLists& lists, Array<uint8_t>& boundary);

}  // namespace tetstream
