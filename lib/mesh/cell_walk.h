// mesh: the way through the window's cells to a place. Depends on window.h.
#pragma once

#include "window.h"

namespace tetstream {

template <class S>
class CellWalk {
 public:
  explicit CellWalk(Account& account) : begin_(account), cells_(account) {}
  // What a cell and a vertex of the window take here.
  static constexpr size_t kCellBytes = 4 * sizeof(uint32_t), kVertexBytes = sizeof(uint32_t);

  // uses[v]: how many live cells v has. Until the window changes.
  void start(const Window<S>& window, const uint32_t* uses);

  // The cell that holds x, or the one from which the way on leads out of the mesh: each time across
  // the face that x is farthest beyond, in heights of the cell, of those with a neighbour.
  uint32_t from(uint32_t cell, const double x[3]) const;

 private:
  uint32_t across(uint32_t cell, uint32_t j) const;

  const Window<S>* window_ = nullptr;
  // The live cells of vertex v are cells_[begin_[v]] to cells_[begin_[v + 1] - 1].
  Array<uint32_t> begin_, cells_;
};

}  // namespace tetstream
