// layout/graph: vertices taken one after the other, breadth first. Depends on vertex_graph.h.
#pragma once

#include "order_front.h"
#include "vertex_graph.h"

namespace tetstream {

// Which vertices and cells of a mesh meet, all that a traversal looks at.
struct Meeting {
  explicit Meeting(Account& account) : lists(account), graph(account) {}
  void find(const Connectivity& mesh, Account& account) {
    listCells(mesh, lists);
    buildGraph(mesh, lists, account, graph);
  }
  CellLists lists;
  VertexGraph graph;
};

// The next vertex is a neighbour of (1) the oldest one taken whose neighbours are not all taken,
// (2) preferably one that completes a cell, (3) the one that was met last (Vo et al. 2007, section
// 3.2). rank[v] becomes the number of those taken before.
class Traversal {
 public:
  Traversal(const Connectivity& mesh, const Meeting& meet, Account& account, Array<uint32_t>& rank);

  void take(uint32_t vertex);
  // Takes all that can be reached from what was taken.
  void goOn();
  // The same from one more vertex, unless it was taken or blocked.
  void from(uint32_t start) {
    if (rank_[start] != kUnused) return;
    take(start);
    goOn();
  }
  // Will not be taken; its rank is kBlocked.
  static constexpr uint32_t kBlocked = kUnused - 1;
  void block(uint32_t vertex) { rank_[vertex] = kBlocked; }

  uint32_t taken() const { return taken_; }
  uint32_t vertexAt(uint32_t rank) const { return queue_[rank]; }

 private:
  uint32_t best(uint32_t vertex) const;

  const Connectivity& mesh_;
  const Meeting& meet_;
  Array<uint32_t> queue_;
  Array<uint32_t> met_;           // when a neighbour was first taken, from 1; 0: not yet
  Array<uint8_t> completes_;      // whether it is the last vertex of some cell
  Array<uint8_t> taken_corners_;  // of each cell
  Array<uint32_t>& rank_;
  uint32_t taken_ = 0, meetings_ = 0, oldest_ = 0;
};

}  // namespace tetstream
