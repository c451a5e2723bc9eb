#include "tiles.h"

#include <algorithm>
#include <limits>

namespace tetstream {

// Three quarters of the 1 MB L2 cache of today's server cores: the rest is for stars and stack.
constexpr size_t kTileBytes = 768 << 10;

template <class S>
size_t Tiles<S>::cellsPerTile() const {
  return std::max<size_t>(kTileBytes / Core<S>::bytesPerCell(core_.plan, core_.options.mode), 1024);
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
  if (count > 0) cut(0, count, cellsPerTile());
}

template <class S>
int Tiles<S>::longestSide(size_t begin, size_t end) const {
  double low[3], high[3];
  std::fill_n(low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
  for (size_t i = begin; i < end; ++i) {
    const S* x = core_.window.values(core_.window.mesh.corners(cells_[i])[0]);
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], static_cast<double>(x[a]));
      high[a] = std::max(high[a], static_cast<double>(x[a]));
    }
  }
  int longest = 0;
  for (int a = 1; a < 3; ++a)
    if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
  return longest;
}

template <class S>
void Tiles<S>::cut(size_t begin, size_t end, size_t most) {
  if (end - begin <= most) {
    std::sort(cells_.data() + begin, cells_.data() + end);
    tiles_.push_back({begin, end});
    return;
  }
  const int axis = longestSide(begin, end);
  const size_t middle = begin + (end - begin) / 2;
  const auto before = [this, axis](uint32_t a, uint32_t b) {
    const S xa = core_.window.values(core_.window.mesh.corners(a)[0])[axis];
    const S xb = core_.window.values(core_.window.mesh.corners(b)[0])[axis];
    return xa != xb ? xa < xb : a < b;
  };
  std::nth_element(cells_.data() + begin, cells_.data() + middle, cells_.data() + end, before);
  cut(begin, middle, most);
  cut(middle, end, most);
}

template class Tiles<float>;
template class Tiles<double>;

}  // namespace tetstream
