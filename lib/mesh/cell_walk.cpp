#include "cell_walk.h"

#include <algorithm>

#include "barycentric.h"

namespace tetstream {

// A way longer than this goes in a circle, as there may be where cells are not those of Delaunay.
// The longest one seen on real meshes had 24 steps.
constexpr int kMostSteps = 200;

template <class S>
void CellWalk<S>::start(const Window<S>& window, const uint32_t* uses) {
  window_ = &window;
  const Topology& mesh = window.mesh;
  if (begin_.size() <= mesh.vertexEnd()) begin_.resize(mesh.vertexCapacity() + 1);
  if (cells_.size() < 4 * size_t{mesh.liveCells()}) cells_.resize(4 * mesh.cellCapacity());
  uint32_t end = 0;
  for (uint32_t v = 0; v < mesh.vertexEnd(); ++v) begin_[v] = end += uses[v];
  begin_[mesh.vertexEnd()] = end;
  for (uint32_t c = 0; c < mesh.cellEnd(); ++c) {
    if (!mesh.isLive(c)) continue;
    for (uint32_t j = 0; j < 4; ++j) cells_[--begin_[mesh.corners(c)[j]]] = c;
  }
}

// The neighbour at the face opposite corner j; kNone if there is none.
template <class S>
uint32_t CellWalk<S>::across(uint32_t cell, uint32_t j) const {
  const uint32_t* const v = window_->mesh.corners(cell);
  const uint32_t a = v[kOpposite[j][0]], b = v[kOpposite[j][1]], c = v[kOpposite[j][2]];
  for (uint32_t i = begin_[a]; i < begin_[a + 1]; ++i) {
    const uint32_t* const w = window_->mesh.corners(cells_[i]);
    const bool has_b = (w[0] == b) | (w[1] == b) | (w[2] == b) | (w[3] == b);
    const bool has_c = (w[0] == c) | (w[1] == c) | (w[2] == c) | (w[3] == c);
    if (has_b && has_c && cells_[i] != cell) return cells_[i];
  }
  return kNone;
}

template <class S>
uint32_t CellWalk<S>::from(uint32_t cell, const double x[3]) const {
  const uint32_t first = cell;
  double corners[4][3], w[4];
  CellFrame frame;
  cornersIn(*window_, cell, corners);
  frame.set(corners[0]);
  for (int step = 0; step < kMostSteps; ++step) {
    frame.weights(x, w);
    uint32_t next = kNone;
    while (next == kNone) {
      const auto j = static_cast<uint32_t>(std::min_element(w, w + 4) - w);
      if (!(w[j] < -kLeastOutside)) return cell;
      w[j] = 0;  // a way that is tried once
      next = across(cell, j);
      if (next == kNone) continue;
      cornersIn(*window_, next, corners);
      CellFrame there;
      if (there.set(corners[0]) == 0)
        next = kNone;  // flat: no way to tell where it leads
      else
        frame = there;
    }
    cell = next;
  }
  return first;
}

template class CellWalk<float>;
template class CellWalk<double>;

}  // namespace tetstream
