#include "tiling.h"

#include <algorithm>

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

// In scratch: 1 for a vertex with an edge to be looked at. Near it: each part of the cells tells
// its neighbours; then those have 1, too.
template <class S>
void Tiling<S>::markVertices(float bound) {
  const Topology& mesh = core_.window.mesh;
  uint32_t* const mark = core_.window.scratch();
  const size_t parts = core_.parts();
  for (size_t p = 0; p < parts; ++p)
    if (parts_[p].near.size() < mesh.vertexEnd()) parts_[p].near.resize(mesh.vertexCapacity());
  core_.forPartsOf(mesh.vertexEnd(), [&](uint32_t first, uint32_t end, size_t part) {
    int64_t looking = 0;
    bool others_wait = false;
    for (uint32_t v = first; v < end; ++v) {
      const float least = settledOf(core_.window, v).least;
      const bool free = mesh.isFree(v);
      mark[v] = free && least <= bound;
      looking += mark[v];
      others_wait |= free && least > bound && least < std::numeric_limits<float>::infinity();
    }
    parts_[part].looking = looking;
    parts_[part].others_wait = others_wait;
  });
  looking_ = 0;
  others_wait_ = false;
  for (size_t p = 0; p < parts; ++p) {
    looking_ += parts_[p].looking;
    others_wait_ |= parts_[p].others_wait;
  }
  core_.forPartsOfCells([&](uint32_t first, uint32_t end, size_t part) {
    uint8_t* const near = parts_[part].near.data();
    std::fill_n(near, mesh.vertexEnd(), uint8_t{0});
    for (uint32_t c = first; c < end; ++c) {
      if (!mesh.isLive(c)) continue;
      const uint32_t* v = mesh.corners(c);
      if ((mark[v[0]] | mark[v[1]] | mark[v[2]] | mark[v[3]]) == 0) continue;
      for (int j = 0; j < 4; ++j) near[v[j]] = 1;
    }
  });
  if (core_.locked.any()) spreadOverLocked();
  markNear();
}

// What lies round a locked vertex on the boundary beside those: a collapse must not push the
// boundary through its faces.
template <class S>
void Tiling<S>::spreadOverLocked() {
  const Topology& mesh = core_.window.mesh;
  const size_t parts = core_.parts();
  core_.forPartsOfCells([&](uint32_t first, uint32_t end, size_t part) {
    const uint8_t* const flags = mesh.allVertexFlags();
    const auto is_near = [&](uint32_t v) {
      bool is = false;
      for (size_t p = 0; p < parts; ++p) is |= parts_[p].near[v] != 0;
      return is;
    };
    const auto leads_on = [&](uint32_t v) {
      constexpr uint8_t kFixed = kLocked | kBoundary;
      return (flags[v] & kFixed) == kFixed && is_near(v);
    };
    for (uint32_t c = first; c < end; ++c) {
      const uint32_t* v = mesh.corners(c);
      if (!mesh.isLive(c) || std::none_of(v, v + 4, leads_on)) continue;
      for (int j = 0; j < 4; ++j)
        if (isFreeVertex(flags[v[j]])) parts_[part].near[v[j]] = 1;
    }
  });
}

template <class S>
void Tiling<S>::markNear() {
  uint32_t* const mark = core_.window.scratch();
  const size_t parts = core_.parts();
  core_.forPartsOf(core_.window.mesh.vertexEnd(), [&](uint32_t first, uint32_t end, size_t) {
    for (size_t p = 0; p < parts; ++p) {
      const uint8_t* const near = parts_[p].near.data();
      for (uint32_t v = first; v < end; ++v) mark[v] |= near[v];
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
    count += mark[v] != 0 && mesh.isFree(v);
    mark[v] = 0;
  }
  return count;
}

// Every other slice is worked on at the same time: of four two, by two threads. Of fewer vertices
// than a quarter of a tile the seams between them would weigh more than that. Windows of more than
// eight tiles have enough that lie apart, at first; slices later on would cost them more in errors
// than they save.
constexpr size_t kFewSlices = 4, kMostSlices = 8, kLeastPart = 4;

// What a pass looks at again are few vertices with many cells. A tile that is smaller still has
// more seams than it has inside. Windows of more tiles have as many pieces, for as many threads,
// but larger ones: of a sixth of a tile they cost 2 % more RMS error at 0.02, of a quarter 0.2 %.
constexpr size_t kPieces = 8, kLeastPieces = 6, kLeastOfWide = 4;
constexpr size_t kMostPieces = 64;  // more threads than that there are seldom

// Windows of so many tiles have enough for all threads where these are as large as may be: seams
// are fewer. Of fewer tiles some more are worth more to threads.
constexpr size_t kManyTiles = 16;

// In a stream's window of so many tiles the layer that came last is thin beside them.
constexpr size_t kLayerTiles = 4;

// The most vertices of one. `tiles`: that the window has.
static size_t pieceOf(size_t vertices, size_t tiles, size_t tile) {
  const size_t least = tile / (tiles > kPieces ? kLeastOfWide : kLeastPieces);
  return std::clamp(vertices / std::clamp(tiles, kPieces, kMostPieces) + 1, least, tile);
}

// Of the window, without those that have come before a cell that has them: how many these are
// depends on how the stream is cut into batches.
template <class S>
size_t Tiling<S>::verticesRead() const {
  return core_.window.mesh.vertexEnd() -
         static_cast<size_t>(core_.front.introduced() - core_.reached);
}

// 0: none. `tile`: the most vertices of one.
template <class S>
size_t Tiling<S>::slicesOf(size_t vertices, size_t tile) const {
  const bool is_large = verticesRead() > kMostSlices * tile;
  if (is_large || vertices < tile / kLeastPart) return 0;
  return vertices > kFewSlices * tile ? kMostSlices : kFewSlices;
}

// Each piece in two, unless it is a leaf; returns where they begin then.
template <class S>
template <class Pieces>
std::vector<size_t> Tiling<S>::cutOnce(Pieces& pieces, const CutRule& rule,
                                       const std::vector<size_t>& begins) const {
  std::vector<size_t> middles(begins.size() - 1);
  doEach(core_.tasks(), middles.size(), [&](size_t k) {
    const bool is_leaf = rule.isLeaf(begins[k + 1] - begins[k]);
    middles[k] = is_leaf ? begins[k] : pieces.cutOnce(begins[k], begins[k + 1]);
  });
  std::vector<size_t> all = {0};
  for (size_t k = 0; k < middles.size(); ++k) {
    if (middles[k] > begins[k]) all.push_back(middles[k]);
    all.push_back(begins[k + 1]);
  }
  return all;
}

template <class S>
void Tiling<S>::cut(size_t count, unsigned round, TileLayout layout) {
  static constexpr double kShare[3] = {0.5, 0.36, 0.64};
  const size_t tiles = verticesRead() / largest_;
  const size_t most = layout == TileLayout::kPieces ? pieceOf(count, tiles, largest_) : largest_;
  const bool is_layer = !core_.holdsAll() && tiles >= kLayerTiles;
  const CutRule rule{kShare[round % 3], most, tiles >= kManyTiles,
                     is_layer ? CutSide::kSparsest : CutSide::kLongest};
  const auto at = [this](uint32_t v, int axis) { return core_.window.values(v)[axis]; };
  MedianCut pieces(vertices_.data(), count, rule, at);
  const size_t slices = layout == TileLayout::kSlices ? slicesOf(count, largest_) : 0;
  are_slices_ = slices > 0;
  if (are_slices_) {
    pieces.slice(0, count, slices, round % 2 == 1, [this](size_t begin, size_t end) {
      tiles_.emplace_back();
      setTile(tiles_.size() - 1, begin, end);
    });
    return;
  }
  tiles_.resize(rule.leavesOf(count));
  // Where each piece begins, that has a thread of its own in the end.
  std::vector<size_t> begins = {0, count};
  for (size_t parts = core_.parts(); begins.size() <= parts;) {
    const size_t before = begins.size();
    begins = cutOnce(pieces, rule, begins);
    if (begins.size() == before) break;
  }
  std::vector<size_t> first_tile = {0};
  for (size_t k = 0; k + 1 < begins.size(); ++k)
    first_tile.push_back(first_tile[k] + rule.leavesOf(begins[k + 1] - begins[k]));
  doEach(core_.tasks(), begins.size() - 1, [&](size_t k) {
    size_t tile = first_tile[k];
    pieces.cut(begins[k], begins[k + 1],
               [&](size_t begin, size_t end) { setTile(tile++, begin, end); });
  });
}

template <class S>
void Tiling<S>::setTile(size_t tile, size_t begin, size_t end) {
  const auto number = static_cast<uint32_t>(tile);
  for (size_t i = begin; i < end; ++i) core_.window.scratch()[vertices_[i]] = number + 1;
  tiles_[tile] = {begin, end, 0, number, 0};
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
void Tiling<S>::sortCells(uint32_t first, uint32_t end, bool whole, Part& part) const {
  const Topology& mesh = core_.window.mesh;
  const uint32_t* of = core_.window.scratch();
  uint32_t tiles[4];
  for (uint32_t c = first; c < end; ++c) {
    if (!mesh.isLive(c)) continue;
    const uint32_t* v = mesh.corners(c);
    const uint32_t last = std::max({of[v[0]], of[v[1]], of[v[2]], of[v[3]]});
    if (last == 0) continue;
    bool others = false;
    for (int j = 0; j < 4; ++j) others |= (of[v[j]] != last) & (of[v[j]] != 0);
    if (!others) {  // as of most
      part.cells.add(last - 1, c);
      continue;
    }
    const size_t count = tilesOf(c, tiles);
    for (size_t k = 1; k < count; ++k)
      for (size_t l = 0; l < k; ++l) part.contacts.add(tiles[k], tiles[l]);
    if (count > 1 && !whole)
      part.addBetween(c);
    else
      for (size_t k = 0; k < count; ++k) part.cells.add(tiles[k], c);
  }
}

template <class S>
void Tiling<S>::Part::addBetween(uint32_t cell) {
  if (between.size() == between_count)
    between.resize(between_count + between_count / 2 + kBlockCells);
  between[between_count++] = cell;
}

template <class S>
void Tiling<S>::sortCells(bool whole) {
  for (Part& part : parts_) {
    part.cells.reset(tiles_.size());
    part.shared.reset(tiles_.size());
    part.contacts.reset(tiles_.size());
    part.torn.clear();
    part.between_count = 0;
  }
  core_.forPartsOfCells([this, whole](uint32_t first, uint32_t end, size_t part) {
    sortCells(first, end, whole, parts_[part]);
  });
  contacts_.reset(tiles_.size());
  for (const Part& part : parts_) contacts_.add(part.contacts);
}

// Vertices of the cell that are of that tile.
template <class S>
void Tiling<S>::leaveOut(uint32_t cell, uint32_t tile) {
  const uint32_t* v = core_.window.mesh.corners(cell);
  uint32_t* const of = core_.window.scratch();
  for (int j = 0; j < 4; ++j) {
    if (of[v[j]] != tile + 1) continue;
    of[v[j]] = 0;
    const bool looked = settledOf(core_.window, v[j]).least <= bound_;
    leaves_out_ |= looked;
    looking_ -= looked;
  }
}

// Whether two of its tiles are to be kept apart.
template <class S>
bool Tiling<S>::isTorn(uint32_t cell) const {
  uint32_t tiles[4];
  const size_t count = tilesOf(cell, tiles);
  for (size_t k = 1; k < count; ++k)
    for (size_t l = 0; l < k; ++l)
      if (contacts_.areApart(tiles[k], tiles[l])) return true;
  return false;
}

// Leaves out what the cell has of all but one of the tiles that are to be kept apart: of two the
// one with fewer corners.
template <class S>
void Tiling<S>::part(uint32_t cell) {
  const uint32_t* v = core_.window.mesh.corners(cell);
  const uint32_t* of = core_.window.scratch();
  const auto corners = [of, v](uint32_t tile) {
    return std::count_if(v, v + 4, [of, tile](uint32_t corner) { return of[corner] == tile + 1; });
  };
  uint32_t tiles[4];
  const size_t count = tilesOf(cell, tiles);
  for (size_t k = 1; k < count; ++k)
    for (size_t l = 0; l < k; ++l)
      if (contacts_.areApart(tiles[k], tiles[l]))
        leaveOut(cell, corners(tiles[k]) < corners(tiles[l]) ? tiles[k] : tiles[l]);
}

template <class S>
void Tiling<S>::dropLeftOut() {
  const uint32_t* of = core_.window.scratch();
  for (TilePiece& tile : tiles_) {
    const auto begin = &vertices_[tile.vertex_begin], end = begin + tile.vertexCount();
    const auto is_left_out = [of, &tile](uint32_t v) { return of[v] != tile.number + 1; };
    tile.vertex_end =
        tile.vertex_begin + static_cast<size_t>(std::remove_if(begin, end, is_left_out) - begin);
  }
}

// Few cells are torn: they are found part by part, and parted in the order of the cells.
template <class S>
void Tiling<S>::keepApart() {
  std::vector<size_t> sizes;
  for (const TilePiece& tile : tiles_) sizes.push_back(tile.vertexCount());
  contacts_.divide(sizes);
  doEach(core_.tasks(), core_.parts(), [this](size_t p) {
    Part& part = parts_[p];
    for (size_t i = 0; i < part.between_count; ++i)
      if (isTorn(part.between[i])) part.torn.push_back(part.between[i]);
  });
  for (const Part& part : parts_)
    for (uint32_t cell : part.torn) this->part(cell);
  dropLeftOut();
}

template <class S>
void Tiling<S>::addBetween() {
  doEach(core_.tasks(), core_.parts(), [this](size_t p) {
    Part& part = parts_[p];
    uint32_t tiles[4];
    for (size_t i = 0; i < part.between_count; ++i) {
      const size_t count = tilesOf(part.between[i], tiles);
      for (size_t k = 0; k < count; ++k) part.shared.add(tiles[k], part.between[i]);
    }
  });
  for (uint32_t tile = 0; tile < tiles_.size(); ++tile) {
    tiles_[tile].cell_count = 0;
    for (const Part& part : parts_)
      tiles_[tile].cell_count += part.cells.count(tile) + part.shared.count(tile);
  }
}

template <class S>
const uint32_t* Tiling<S>::listCells(const TilePiece& t, Array<uint32_t>& room) const {
  if (room.size() < t.cell_count) room.resize(t.cell_count + t.cell_count / 4);
  uint32_t* to = room.data();
  for (TileCells Part::*cells : {&Part::cells, &Part::shared})
    for (const Part& part : parts_) {
      (part.*cells).copy(t.number, to);
      to += (part.*cells).count(t.number);
    }
  return room.data();
}

// The lowest colour that no tile has of those that it meets: of one side first, then of the other.
template <class S>
void Tiling<S>::colour() {
  for (TilePiece& tile : tiles_) tile.colour = kNone;
  std::vector<bool> taken;
  for (int side : {0, 1})
    for (TilePiece& tile : tiles_) {
      if (contacts_.side(tile.number) != side) continue;
      const std::vector<TileContacts::Contact>& contacts = contacts_.of(tile.number);
      taken.assign(contacts.size() + 1, false);
      for (const TileContacts::Contact& contact : contacts) {
        const uint32_t colour = tiles_[contact.tile].colour;
        if (!contact.apart && colour < taken.size()) taken[colour] = true;
      }
      tile.colour =
          static_cast<uint32_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
    }
}

template <class S>
void Tiling<S>::sortByColour() {
  std::stable_sort(tiles_.begin(), tiles_.end(),
                   [](const TilePiece& a, const TilePiece& b) { return a.colour < b.colour; });
  std::vector<uint32_t> place(tiles_.size());
  for (uint32_t i = 0; i < tiles_.size(); ++i) place[tiles_[i].number] = i;
  earlier_.assign(tiles_.size(), {});
  for (uint32_t i = 0; i < tiles_.size(); ++i)
    for (const TileContacts::Contact& contact : contacts_.of(tiles_[i].number))
      if (!contact.apart && place[contact.tile] < i) earlier_[i].push_back(place[contact.tile]);
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
void Tiling<S>::build(unsigned round, float bound, TileLayout layout) {
  tiles_.clear();
  bound_ = bound;
  leaves_out_ = are_slices_ = false;
  markVertices(bound);
  const size_t count = listVertices();
  if (count == 0) return;
  cut(count, round, layout);
  sortCells(layout == TileLayout::kWhole);
  if (layout != TileLayout::kWhole) keepApart();
  addBetween();
  colour();
  sortByColour();
  lookAhead();
}

template class Tiling<float>;
template class Tiling<double>;

}  // namespace tetstream
