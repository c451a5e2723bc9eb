// mesh/topology: the cells of the window as a corner table. Depends on base.
//
// After Vo et al. 2007, section 4: corner c = 4 * cell + j belongs to the j-th vertex of its cell;
// V[c] is that vertex and L[c] the next corner of the same vertex, in a circle; each vertex knows
// one of its corners. Cells die lazily: a dead cell's corners stay in their circles until somebody
// walks over them or the window is packed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "cell_faces.h"
#include "memory.h"

namespace tetstream {

constexpr uint32_t kNone = 0xffffffffu;

enum VertexFlag : uint8_t {
  kFinal = 1,        // no later cell will use it
  kBoundary = 2,     // on the boundary of the domain (known once it or a neighbour there is final)
  kLocked = 4,       // never moved: corner, non-manifold boundary, bad cell, or the caller's wish
  kWritten = 8,      // a cell that uses it has left, or is parked: it is frozen
  kCollapsed = 16,   // merged into another vertex
  kInterface = 128,  // cells of different regions meet there (known as kBoundary is)
};

// On a sheet: the boundary of the domain or an interface of regions.
constexpr uint8_t kOnSheet = kBoundary | kInterface;

constexpr bool isFreeVertex(uint8_t flags) {
  return (flags & (kFinal | kLocked | kWritten | kCollapsed)) == kFinal;
}

enum CellFlag : uint8_t {
  kNegative = 1,  // stored with negative volume; the order is the user's and is kept
  kDead = 2,
  kFlat = 4,     // of volume zero in the input
  kFolded = 8,   // on the same side of a face as the neighbour there, in the input
  kShaped = 16,  // no flip was found that makes its shape better; none will be while all stays
  kParked = 32,  // out of sight until it is taken back
};

// One cell round a centre: the triangle opposite, ordered so that det(t0 - x, t1 - x, t2 - x) > 0
// for a centre x that keeps the cell's orientation.
struct StarCell {
  uint32_t cell;
  uint32_t t[3];
  bool has(uint32_t v) const { return (t[0] == v) | (t[1] == v) | (t[2] == v); }
};

class Star {
 public:
  explicit Star(Account& account, size_t room = 256) : cells_(account, room) {}
  size_t size() const { return size_; }
  const StarCell& operator[](size_t i) const { return cells_[i]; }
  const StarCell* begin() const { return cells_.data(); }
  const StarCell* end() const { return cells_.data() + size_; }
  void clear() { size_ = 0; }
  // Room for `count` more, to be filled from end() on and counted by grow.
  StarCell* room(size_t count) {
    while (size_ + count > cells_.size()) cells_.resize(2 * cells_.size());
    return cells_.data() + size_;
  }
  void grow(size_t count) { size_ += count; }
  StarCell& add() {
    if (size_ == cells_.size()) cells_.resize(2 * size_);
    return cells_[size_++];
  }

 private:
  Array<StarCell> cells_;
  size_t size_ = 0;
};

// The cells round the edge uv: those that hold both, and the others of each end.
struct Stars {
  explicit Stars(Account& account) : ring(account), ring_from_v(account), u(account), v(account) {}
  Star ring, ring_from_v;  // from u, from v
  Star u, v;
};

class Topology {
 public:
  // Without links (L), half the memory: no stars are gathered and nothing is merged here then, but
  // in patches (patch.h).
  Topology(Account& account, size_t cell_capacity, size_t vertex_capacity, bool linked = true);

  size_t cellCapacity() const { return cell_flags_.size(); }
  size_t vertexCapacity() const { return vertex_flags_.size(); }
  // Corners are numbered with 32 bits, pairs of vertices and two bits with 64: windows have at most
  // so many cells, and so many vertices.
  static constexpr size_t kMost = (size_t{1} << 30) - 1;
  void growCells(size_t capacity);
  void growVertices(size_t capacity);

  // Those slots will be taken soon.
  void expectCells(size_t first, size_t end);
  void expectVertices(size_t first, size_t end);

  uint32_t addVertex(uint8_t flags);
  uint32_t addCell(const uint32_t corners[4], uint8_t flags);

  uint32_t vertexEnd() const { return vertex_end_; }  // all slots in use are below
  uint32_t cellEnd() const { return cell_end_; }
  uint32_t liveCells() const { return live_cells_; }

  const uint32_t* corners(uint32_t cell) const { return &vertex_of_[4 * size_t{cell}]; }
  uint8_t vertexFlags(uint32_t v) const { return vertex_flags_[v]; }
  const uint8_t* allVertexFlags() const { return vertex_flags_.data(); }
  void flagVertex(uint32_t v, uint8_t flags) { vertex_flags_[v] |= flags; }
  uint8_t cellFlags(uint32_t c) const { return cell_flags_[c]; }
  void flagCell(uint32_t c, uint8_t flags) { cell_flags_[c] |= flags; }
  void unflagCell(uint32_t c, uint8_t flags) { cell_flags_[c] &= static_cast<uint8_t>(~flags); }
  bool isLive(uint32_t c) const { return !(cell_flags_[c] & (kDead | kParked)); }
  // May be merged with another such vertex, as far as the vertex itself goes.
  bool isFree(uint32_t v) const { return isFreeVertex(vertex_flags_[v]); }

  // The live cells round v: those that hold `other` into `ring`, the rest into `star`. Takes dead
  // corners out of v's circle on the way.
  void gather(uint32_t v, uint32_t other, Star& star, Star& ring);

  // The live cells round v; false, and not all of them, where it has more corners than `most`.
  bool gatherUpTo(uint32_t v, size_t most, Star& star) const;

  // One cell of v's star.
  StarCell starCell(uint32_t corner) const {
    const uint32_t cell = corner / 4, j = corner % 4;
    const uint32_t* const v = corners(cell);
    const uint32_t swap = cell_flags_[cell] & kNegative;
    return {cell, {v[kOpposite[j][0]], v[kOpposite[j][1 + swap]], v[kOpposite[j][2 - swap]]}};
  }

  void kill(uint32_t cell);
  // A live cell stays where it is, but counts as none, until all are taken back; their vertices,
  // which have this flag meanwhile, lose it then.
  void park(uint32_t cell);
  uint32_t parkedCells() const { return parked_cells_; }
  // While cells are parked none has left.
  bool isOfParked(uint32_t v) const { return parked_cells_ > 0 && (vertex_flags_[v] & kWritten); }
  void takeBack(uint8_t vertex_flag);
  // Cells were flagged as dead, not counted.
  void countOut(int64_t cells) { live_cells_ -= static_cast<uint32_t>(cells); }
  void setCorner(uint32_t corner, uint32_t v) { vertex_of_[corner] = v; }  // without links
  // The cells of the ring, which hold both vertices, die, those of v's star get u in its place, v
  // is gone. As gathered.
  void merge(uint32_t u, uint32_t v, const Stars& stars);

  // Drops dead cells and the vertices for which keep[v] is kNone; keep[v] otherwise is v's new
  // slot, increasing with v. Cells keep their order; calls moved(old, new) for each that stays.
  template <class Moved>
  void pack(const uint32_t* keep, uint32_t kept_vertices, Moved moved);

 private:
  void link(uint32_t corner, uint32_t v);
  uint32_t cornerOf(uint32_t cell, uint32_t v) const;

  bool linked_;
  Array<uint32_t> vertex_of_, next_;  // per corner: V and L
  Array<uint8_t> cell_flags_;
  Array<uint32_t> first_corner_;  // per vertex
  Array<uint8_t> vertex_flags_;
  uint32_t vertex_end_ = 0, cell_end_ = 0, live_cells_ = 0, parked_cells_ = 0;
};

template <class Moved>
void Topology::pack(const uint32_t* keep, uint32_t kept_vertices, Moved moved) {
  for (uint32_t v = 0; v < vertex_end_; ++v)
    if (keep[v] != kNone) vertex_flags_[keep[v]] = vertex_flags_[v];
  vertex_end_ = kept_vertices;
  if (linked_) std::fill_n(first_corner_.data(), vertex_end_, kNone);
  uint32_t to = 0;
  for (uint32_t from = 0; from < cell_end_; ++from) {
    if (cell_flags_[from] & kDead) continue;
    cell_flags_[to] = cell_flags_[from];
    for (uint32_t j = 0; j < 4; ++j) {
      const uint32_t v = keep[vertex_of_[4 * size_t{from} + j]];
      vertex_of_[4 * size_t{to} + j] = v;
      if (linked_) link(4 * to + j, v);
    }
    moved(from, to);
    ++to;
  }
  cell_end_ = to;
  live_cells_ = to - parked_cells_;
}

}  // namespace tetstream
