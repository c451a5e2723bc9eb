#include "patch.h"

#include <algorithm>
#include <cstring>

#include "star_kernels.h"

namespace tetstream {

template <class S>
Patch<S>::Patch(Account& account, Window<S>& window)
    : account_(&account),
      window_(window),
      value_stride_(static_cast<size_t>(window.shape().values)),
      quadric_stride_(static_cast<size_t>(window.shape().quadric)),
      local_of_(account),
      global_vertex_(account),
      global_cell_(account),
      corner_(account),
      flags_(account),
      values_(account),
      quadrics_(account),
      star_of_(account),
      lists_(account),
      rim_(account),
      gone_(account) {}

template <class T>
static void ensure(Array<T>& array, size_t size) {
  if (array.size() >= size) return;
  array.resize(size + size / 4);
  array.expect(0, size);
}

template <class S>
void Patch<S>::sizeFor(size_t owned, size_t cells) {
  const size_t before = local_of_.size();
  if (before < window_.mesh.vertexEnd()) {
    local_of_.resize(window_.mesh.vertexCapacity());
    std::fill(local_of_.data() + before, local_of_.data() + local_of_.size(), kGoneCorner);
  }
  ensure(global_cell_, cells);
  ensure(corner_, 4 * cells);
  ensure(quadrics_, (owned + 1) * quadric_stride_ + 3);  // rows are read four numbers at a time
  ensure(star_of_, owned + 1);
}

// Rows of the window are on their way before they are looked at.
constexpr uint32_t kAhead = 8;

template <class S>
void Patch<S>::prefetchRows(uint32_t slot) const {
  __builtin_prefetch(window_.values(slot));
  __builtin_prefetch(window_.quadric(slot));
  __builtin_prefetch(window_.quadric(slot) + quadric_stride_ - 1);
}

template <class S>
void Patch<S>::loadVertex(uint32_t slot) {
  const size_t v = vertices_++;
  if (v >= global_vertex_.size()) {
    ensure(global_vertex_, v + std::min<size_t>(v / 2 + 64, 1024));
    flags_.resize(global_vertex_.size());
    values_.resize(global_vertex_.size() * value_stride_ + 3);
    values_.expect(v * value_stride_, values_.size());
  }
  local_of_[slot] = static_cast<uint16_t>(v);
  global_vertex_[v] = slot;
  flags_[v] = window_.mesh.vertexFlags(slot);
  copyRow(window_.values(slot), value_stride_, values(static_cast<uint32_t>(v)));
}

template <class S>
bool Patch<S>::takeCells(const uint32_t* cells, size_t count) {
  const Topology& mesh = window_.mesh;
  for (size_t i = 0; i < count; ++i) {
    __builtin_prefetch(mesh.corners(cells[std::min<size_t>(i + 2 * kAhead, count - 1)]));
    if (!mesh.isLive(cells[i])) continue;
    const uint32_t* v = mesh.corners(cells[i]);
    const uint32_t swap = mesh.cellFlags(cells[i]) & kNegative;
    uint16_t* corner = &corner_[4 * size_t{cells_}];
    for (uint32_t j = 0; j < 4; ++j) {
      if (local_of_[v[j]] == kGoneCorner) {
        if (vertices_ == kMostVertices) return false;
        loadVertex(v[j]);
      }
      const uint16_t local = local_of_[v[j]];
      corner[j < 2 ? j : j ^ swap] = local;
      ++starOrRim(local).size;
    }
    global_cell_[cells_++] = cells[i];
  }
  return true;
}

template <class S>
void Patch<S>::listStars() {
  const size_t corners = 4 * size_t{cells_};
  lists_end_ = 0;
  largest_star_ = 0;
  for (uint32_t v = 0; v < owned_; ++v) {
    star_of_[v].begin = static_cast<uint32_t>(lists_end_);
    lists_end_ += star_of_[v].size;
    largest_star_ = std::max(largest_star_, star_of_[v].size);
  }
  star_of_[owned_].begin = static_cast<uint32_t>(lists_end_);
  ensure(lists_, std::max(2 * lists_end_ + 4096, corners));
  for (size_t c = 0; c < corners; ++c)
    lists_[starOrRim(corner_[c]).begin++] = static_cast<uint16_t>(c / 4);
  for (uint32_t v = 0; v < owned_; ++v) star_of_[v].begin -= star_of_[v].size;
}

template <class S>
void Patch<S>::forget() {
  for (uint32_t v = 0; v < vertices_; ++v) local_of_[global_vertex_[v]] = kGoneCorner;
  vertices_ = cells_ = 0;
}

template <class S>
bool Patch<S>::load(const uint32_t* owned, size_t owned_count, const uint32_t* cells,
                    size_t cell_count, int64_t live_cells) {
  if (cell_count > kMostCells || owned_count > kMostVertices) return false;
  forget();
  sizeFor(owned_count, cell_count);
  for (size_t i = 0; i < owned_count; ++i) {
    prefetchRows(owned[std::min<size_t>(i + kAhead, owned_count - 1)]);
    loadVertex(owned[i]);
    copyRow(window_.quadric(owned[i]), quadric_stride_, quadric(static_cast<uint32_t>(i)));
  }
  owned_ = vertices_;
  std::fill_n(star_of_.data(), owned_ + 1, List{0, 0});
  if (!takeCells(cells, cell_count)) {
    forget();
    return false;
  }
  listStars();
  rim_listed_ = false;
  live_ = live_cells;
  return true;
}

// Returns whether the cell lives.
template <class S>
bool Patch<S>::storeCell(uint32_t c) {
  Topology& mesh = window_.mesh;
  const uint32_t cell = global_cell_[c];
  if (!isLive(c)) {
    mesh.flagCell(cell, kDead);
    return false;
  }
  const uint32_t swap = mesh.cellFlags(cell) & kNegative ? 1 : 0;
  mesh.setCorner(4 * cell, global_vertex_[vertexOf(c, 0)]);
  mesh.setCorner(4 * cell + 1, global_vertex_[vertexOf(c, 1)]);
  mesh.setCorner(4 * cell + 2, global_vertex_[vertexOf(c, 2 + swap)]);
  mesh.setCorner(4 * cell + 3, global_vertex_[vertexOf(c, 3 - swap)]);
  return true;
}

template <class S>
int64_t Patch<S>::storeUncounted() {
  int64_t died = 0;
  for (uint32_t c = 0; c < cells_; ++c) died += !storeCell(c);
  for (uint32_t v = 0; v < owned_; ++v) {
    const uint32_t slot = global_vertex_[v];
    window_.mesh.flagVertex(slot, flags_[v]);
    if (flags_[v] & kCollapsed) continue;
    copyRow(values(v), value_stride_, window_.values(slot));
    copyRow(quadric(v), quadric_stride_, window_.quadric(slot));
  }
  return died;
}

template <class S>
void Patch<S>::gather(uint32_t v, uint32_t other, Star& star, Star& ring) {
  List& list = star_of_[v];
  star.clear();
  ring.clear();
  const StarCounts counts =
      lookRound(corner_.data(), lists_.data() + list.begin, list.size, static_cast<uint16_t>(v),
                static_cast<uint16_t>(other), star.room(list.size + kStarSlack),
                ring.room(list.size + kStarSlack));
  star.grow(counts.star);
  ring.grow(counts.ring);
  list.size = counts.star + counts.ring;
}

// Cells that are merged or flipped keep their vertices of the rim, or die.
template <class S>
void Patch<S>::listRim() {
  const auto forCorners = [this](auto visit) {
    for (uint32_t c = 0; c < cells_; ++c)
      for (uint32_t j = 0; j < 4; ++j) {
        const uint32_t v = vertexOf(c, j);
        if (v >= owned_ && v != kGoneCorner && isBoundary(v)) visit(v << 16 | c);
      }
  };
  rim_end_ = 0;
  forCorners([this](uint32_t) { ++rim_end_; });
  ensure(rim_, rim_end_);
  forCorners([at = rim_.data()](uint32_t corner) mutable { *at++ = corner; });
  std::sort(rim_.data(), rim_.data() + rim_end_);
  rim_listed_ = true;
}

template <class S>
bool Patch<S>::gatherOnBoundary(uint32_t v, size_t most, Star& star) {
  star.clear();
  if (v < owned_) {
    List& list = star_of_[v];
    if (list.size > most) return false;
    const size_t room = list.size + kStarSlack;
    StarCell* const cells = star.room(2 * room);  // the second half for a ring that is empty
    list.size = lookRound(corner_.data(), lists_.data() + list.begin, list.size,
                          static_cast<uint16_t>(v), kGoneCorner, cells, cells + room)
                    .star;
    star.grow(list.size);
    return true;
  }
  if (!rim_listed_) listRim();
  const uint32_t *const begin = rim_.data(), *const end = begin + rim_end_;
  const uint32_t *first = std::lower_bound(begin, end, v << 16), *last = first;
  while (last < end && *last >> 16 == v) {
    if (static_cast<size_t>(++last - first) > most) return false;  // it may have any number
  }
  for (; first < last; ++first) addCell(*first & 0xffff, v, star);
  return true;
}

// Where the cell still has the vertex.
template <class S>
void Patch<S>::addCell(uint32_t c, uint32_t v, Star& star) const {
  for (uint32_t j = 0; j < 4; ++j)
    if (vertexOf(c, j) == v) star.add() = starCell(4 * c + j);
}

// Lists are only ever appended; when the room is used up, those of vertices that are left move.
template <class S>
uint16_t* Patch<S>::roomFor(size_t count) {
  if (lists_end_ + count > lists_.size()) {
    size_t live = 0;
    for (uint32_t v = 0; v < owned_; ++v) live += star_of_[v].size;
    Array<uint16_t> larger(*account_, 2 * live + count + 4096);
    size_t end = 0;
    for (uint32_t v = 0; v < owned_; ++v) {
      const uint16_t* from = lists_.data() + star_of_[v].begin;
      star_of_[v].begin = static_cast<uint32_t>(end);
      std::copy_n(from, star_of_[v].size, larger.data() + end);
      end += star_of_[v].size;
    }
    lists_.swap(larger);
    lists_end_ = end;
  }
  return lists_.data() + lists_end_;
}

// Of the four corners of a cell those that are v become u.
static void renumber(uint16_t* cell, uint16_t v, uint16_t u) {
  typedef uint16_t Corners __attribute__((vector_size(8)));
  Corners corners;
  std::memcpy(&corners, cell, sizeof corners);
  corners ^= static_cast<Corners>(corners == (Corners{} + v)) & static_cast<uint16_t>(u ^ v);
  std::memcpy(cell, &corners, sizeof corners);
}

template <class S>
void Patch<S>::merge(uint32_t u, uint32_t v, const Stars& stars) {
  star_of_[u].size = star_of_[v].size = 0;
  uint16_t* cells = roomFor(stars.u.size() + stars.v.size());
  uint32_t count = 0;
  for (const StarCell& s : stars.ring) std::fill_n(&corner_[4 * size_t{s.cell}], 4, kGoneCorner);
  for (const StarCell& s : stars.u) cells[count++] = static_cast<uint16_t>(s.cell);
  for (const StarCell& s : stars.v) {
    renumber(&corner_[4 * size_t{s.cell}], static_cast<uint16_t>(v), static_cast<uint16_t>(u));
    cells[count++] = static_cast<uint16_t>(s.cell);
  }
  live_ -= static_cast<int64_t>(stars.ring.size());
  star_of_[u] = {static_cast<uint32_t>(lists_end_), count};
  lists_end_ += count;
  flags_[v] |= kCollapsed;
  flags_[u] |= flags_[v] & kOnSheet;
}

// Lists hold dead cells until somebody looks: no more.
template <class S>
void Patch<S>::listGone() {
  for (uint32_t v = 0; v < owned_; ++v) {
    List& list = star_of_[v];
    uint16_t* const cells = lists_.data() + list.begin;
    const auto dead = [this](uint16_t c) { return !isLive(c); };
    list.size = static_cast<uint32_t>(std::remove_if(cells, cells + list.size, dead) - cells);
  }
  ensure(gone_, cells_);
  gone_end_ = 0;
  for (uint32_t c = cells_; c-- > 0;)
    if (!isLive(c)) gone_[gone_end_++] = static_cast<uint16_t>(c);
}

template <class S>
void Patch<S>::unlist(uint32_t c) {
  for (uint32_t j = 0; j < 4; ++j) {
    if (vertexOf(c, j) >= owned_) continue;
    List& list = star_of_[vertexOf(c, j)];
    uint16_t* const cells = lists_.data() + list.begin;
    list.size = static_cast<uint32_t>(std::remove(cells, cells + list.size, c) - cells);
  }
}

template <class S>
void Patch<S>::list(uint32_t c) {
  for (uint32_t j = 0; j < 4; ++j) {
    if (vertexOf(c, j) >= owned_) continue;
    List& list = star_of_[vertexOf(c, j)];
    uint16_t* const cells = roomFor(list.size + 1);
    std::copy_n(lists_.data() + list.begin, list.size, cells);
    cells[list.size] = static_cast<uint16_t>(c);
    list.begin = static_cast<uint32_t>(lists_end_);
    lists_end_ += ++list.size;
  }
}

template <class S>
void Patch<S>::replace(const uint32_t* gone, uint32_t gone_count, const uint32_t (*made)[4],
                       uint32_t made_count, uint32_t* slots) {
  for (uint32_t i = 0; i < gone_count; ++i) {
    unlist(gone[i]);
    std::fill_n(&corner_[4 * size_t{gone[i]}], 4, kGoneCorner);
  }
  for (uint32_t i = made_count; i < gone_count; ++i)
    gone_[gone_end_++] = static_cast<uint16_t>(gone[i]);
  for (uint32_t i = 0; i < made_count; ++i) {
    slots[i] = i < gone_count ? gone[i] : gone_[--gone_end_];
    for (uint32_t j = 0; j < 4; ++j)
      corner_[4 * size_t{slots[i]} + j] = static_cast<uint16_t>(made[i][j]);
    list(slots[i]);
  }
  rim_listed_ = false;
  live_ += static_cast<int64_t>(made_count) - static_cast<int64_t>(gone_count);
}

template class Patch<float>;
template class Patch<double>;

}  // namespace tetstream
