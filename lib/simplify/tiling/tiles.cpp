#include "tiles.h"

#include <algorithm>

#include "median_cut.h"

namespace tetstream {

// Three quarters of the 1 MB L2 cache of today's server cores: the rest is for stars and stack.
constexpr size_t kTileBytes = 768 << 10;

template <class S>
size_t Tiles<S>::cellsPerTile() const {
  return std::max<size_t>(kTileBytes / Core<S>::bytesPerCell(core_.plan, core_.options), 1024);
}

template <class S>
void Tiles<S>::build() {
  const Topology& mesh = core_.window.mesh;
  if (cells_.size() < mesh.cellCapacity()) cells_.resize(mesh.cellCapacity());
  tiles_.clear();
  size_t count = 0;
  for (uint32_t c = 0; c < mesh.cellEnd(); ++c) {
    if (!mesh.isLive(c)) continue;
    int free = 0;
    for (int j = 0; j < 4; ++j) free += mesh.isFree(mesh.corners(c)[j]);
    if (free >= 2) cells_[count++] = c;
  }
  if (count == 0) return;
  const auto at = [this](uint32_t cell, int axis) {
    return static_cast<double>(core_.window.values(core_.window.mesh.corners(cell)[0])[axis]);
  };
  MedianCut cut(cells_.data(), count, {0.5, cellsPerTile()}, at);
  cut.cut(0, count, [this](size_t begin, size_t end) { tiles_.push_back({begin, end}); });
}

template class Tiles<float>;
template class Tiles<double>;

}  // namespace tetstream
