#include "tiling.h"

#include <algorithm>
#include <numeric>

#include "median_cut.h"
#include "settled.h"

namespace tetstream {

constexpr size_t kBlockCells = 256;

void TileCells::reset(size_t tiles) {
  lists_.assign(tiles, {0, 0});
  block_before_.clear();
}

void TileCells::add(uint32_t tile, uint32_t cell) {
  List& list = lists_[tile];
  const size_t place = list.count++ % kBlockCells;
  if (place == 0) {
    block_before_.push_back(list.last_block);
    list.last_block = static_cast<uint32_t>(block_before_.size() - 1);
    const size_t size = kBlockCells * block_before_.size();
    if (cells_.size() < size) cells_.resize(size + size / 8);
  }
  cells_[kBlockCells * list.last_block + place] = cell;
}

void TileCells::copy(size_t tile, uint32_t* to) const {
  uint32_t block = lists_[tile].last_block;
  for (size_t end = lists_[tile].count; end > 0; block = block_before_[block]) {
    const size_t begin = (end - 1) / kBlockCells * kBlockCells;
    std::copy_n(&cells_[kBlockCells * block], end - begin, to + begin);
    end = begin;
  }
}

// In scratch: 1 for a vertex with an edge to be looked at. Near it: each half of the cells tells
// its neighbours.
template <class S>
void Tiling<S>::markVertices(float bound) {
  const Topology& mesh = core_.window.mesh;
  uint32_t* const mark = core_.window.scratch();
  others_wait_ = false;
  looking_ = 0;
  for (uint32_t v = 0; v < mesh.vertexEnd(); ++v) {
    const float least = settledOf(core_.window, v).least;
    const bool free = mesh.isFree(v);
    mark[v] = free && least <= bound;
    looking_ += mark[v];
    others_wait_ |= free && least > bound && least < std::numeric_limits<float>::infinity();
  }
  for (Part& part : parts_)
    if (part.near.size() < mesh.vertexEnd()) part.near.resize(mesh.vertexCapacity());
  core_.forHalves([&](uint32_t first, uint32_t end, unsigned half) {
    uint8_t* const near = parts_[half].near.data();
    std::fill_n(near, mesh.vertexEnd(), uint8_t{0});
    for (uint32_t c = first; c < end; ++c) {
      if (!mesh.isLive(c)) continue;
      const uint32_t* v = mesh.corners(c);
      if ((mark[v[0]] | mark[v[1]] | mark[v[2]] | mark[v[3]]) == 0) continue;
      for (int j = 0; j < 4; ++j) near[v[j]] = 1;
    }
  });
}

template <class S>
size_t Tiling<S>::listVertices() {
  const Topology& mesh = core_.window.mesh;
  uint32_t* const mark = core_.window.scratch();
  if (vertices_.size() < mesh.vertexEnd()) vertices_.resize(mesh.vertexCapacity());
  size_t count = 0;
  for (uint32_t v = 0; v < mesh.vertexEnd(); ++v) {
    vertices_[count] = v;
    count += (mark[v] | parts_[0].near[v] | parts_[1].near[v]) != 0 && mesh.isFree(v);
    mark[v] = 0;
  }
  return count;
}

// Every other slice is worked on at the same time: of four two, by two threads. Of fewer vertices
// than a quarter of a tile the seams between them would weigh more than that. Windows of more than
// eight tiles have enough that lie apart, at first; slices later on would cost them more in errors
// than they save.
constexpr size_t kFewSlices = 4, kMostSlices = 8, kLeastPart = 4;

// 0: none. `tile`: the most vertices of one.
template <class S>
size_t Tiling<S>::slicesOf(size_t vertices, size_t tile) const {
  const bool is_large = core_.window.mesh.vertexEnd() > kMostSlices * tile;
  if (is_large || vertices < tile / kLeastPart) return 0;
  return vertices > kFewSlices * tile ? kMostSlices : kFewSlices;
}

template <class S>
void Tiling<S>::cut(size_t count, unsigned round, bool together) {
  static constexpr double kShare[3] = {0.5, 0.36, 0.64};
  const auto most =
      static_cast<size_t>(tileVertices(core_.options, Core<S>::tileVertexBytes(core_.plan)));
  const CutRule rule{kShare[round % 3], most};
  const auto at = [this](uint32_t v, int axis) { return core_.window.values(v)[axis]; };
  MedianCut pieces(vertices_.data(), rule, at);
  const auto add = [this](size_t begin, size_t end) {
    const uint32_t tile = static_cast<uint32_t>(tiles_.size()) + 1;
    for (size_t i = begin; i < end; ++i) core_.window.scratch()[vertices_[i]] = tile;
    tiles_.push_back({begin, end, 0, tile - 1, 0});
  };
  const size_t slices = together ? slicesOf(count, most) : 0;
  are_slices_ = slices > 0;
  if (are_slices_)
    pieces.slice(0, count, slices, round % 2 == 1, add);
  else
    pieces.cut(0, count, add);
}

// The tiles that own a vertex of the cell, each once.
template <class S>
size_t Tiling<S>::tilesOf(uint32_t cell, uint32_t tiles[4]) const {
  const uint32_t* v = core_.window.mesh.corners(cell);
  const uint32_t* of = core_.window.scratch();
  size_t count = 0;
  for (int j = 0; j < 4; ++j) {
    const uint32_t tile = of[v[j]];
    bool known = tile == 0;
    for (size_t k = 0; k < count; ++k) known |= tiles[k] == tile - 1;
    if (!known) tiles[count++] = tile - 1;
  }
  return count;
}

template <class S>
void Tiling<S>::meet(uint32_t a, uint32_t b, Earlier& earlier) {
  std::vector<uint32_t>& of = earlier[std::max(a, b)];
  const uint32_t other = std::min(a, b);
  if (std::find(of.begin(), of.end(), other) == of.end()) of.push_back(other);
}

template <class S>
void Tiling<S>::addCells(uint32_t first, uint32_t end, Part& part) const {
  const Topology& mesh = core_.window.mesh;
  const uint32_t* of = core_.window.scratch();
  uint32_t tiles[4];
  for (uint32_t c = first; c < end; ++c) {
    if (!mesh.isLive(c)) continue;
    const uint32_t* v = mesh.corners(c);
    if (of[v[0]] == of[v[1]] && of[v[0]] == of[v[2]] && of[v[0]] == of[v[3]]) {
      if (of[v[0]] != 0) part.cells.add(of[v[0]] - 1, c);  // most cells are in one tile or in none
      continue;
    }
    const size_t count = tilesOf(c, tiles);
    for (size_t k = 0; k < count; ++k) part.cells.add(tiles[k], c);
    for (size_t k = 1; k < count; ++k)
      for (size_t l = 0; l < k; ++l) meet(tiles[k], tiles[l], part.earlier);
  }
}

template <class S>
void Tiling<S>::addCells() {
  for (Part& part : parts_) {
    part.cells.reset(tiles_.size());
    part.earlier.assign(tiles_.size(), {});
  }
  core_.forHalves(
      [this](uint32_t first, uint32_t end, unsigned half) { addCells(first, end, parts_[half]); });
  earlier_ = parts_[0].earlier;
  for (uint32_t tile = 0; tile < tiles_.size(); ++tile) {
    for (uint32_t other : parts_[1].earlier[tile]) meet(tile, other, earlier_);
    tiles_[tile].cell_count = parts_[0].cells.count(tile) + parts_[1].cells.count(tile);
  }
}

template <class S>
const uint32_t* Tiling<S>::listCells(const TilePiece& t, Array<uint32_t>& room) const {
  if (room.size() < t.cell_count) room.resize(t.cell_count + t.cell_count / 4);
  parts_[0].cells.copy(t.number, room.data());
  parts_[1].cells.copy(t.number, room.data() + parts_[0].cells.count(t.number));
  return room.data();
}

// The lowest colour that no neighbour before it has.
template <class S>
void Tiling<S>::colour() {
  std::vector<bool> taken;
  for (size_t i = 0; i < tiles_.size(); ++i) {
    taken.assign(earlier_[i].size() + 1, false);
    for (uint32_t n : earlier_[i])
      if (tiles_[n].colour < taken.size()) taken[tiles_[n].colour] = true;
    tiles_[i].colour =
        static_cast<uint32_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
  }
}

template <class S>
void Tiling<S>::sortByColour() {
  std::vector<uint32_t> order(tiles_.size()), place(tiles_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [this](uint32_t a, uint32_t b) { return tiles_[a].colour < tiles_[b].colour; });
  for (uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<TilePiece> tiles;
  std::vector<std::vector<uint32_t>> earlier(tiles_.size());
  for (uint32_t a : order) {
    tiles.push_back(tiles_[a]);
    for (uint32_t b : earlier_[a])
      earlier[std::max(place[a], place[b])].push_back(std::min(place[a], place[b]));
  }
  tiles_.swap(tiles);
  earlier_.swap(earlier);
}

template <class S>
void Tiling<S>::lookAhead() {
  ahead_.assign(tiles_.size(), 0);
  for (size_t i = tiles_.size(); i-- > 0;) {  // all that wait for it come behind it
    ahead_[i] += tiles_[i].cell_count;
    for (uint32_t other : earlier_[i]) ahead_[other] = std::max(ahead_[other], ahead_[i]);
  }
}

template <class S>
void Tiling<S>::build(unsigned round, float bound, bool together) {
  tiles_.clear();
  are_slices_ = false;
  markVertices(bound);
  const size_t count = listVertices();
  if (count == 0) return;
  cut(count, round, together);
  addCells();
  colour();
  sortByColour();
  lookAhead();
}

template class Tiling<float>;
template class Tiling<double>;

}  // namespace tetstream
