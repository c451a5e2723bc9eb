#include "topology.h"

#include <utility>

#include "status.h"

namespace tetstream {

static void checkRoom(size_t wanted, const char* what) {
  if (wanted > Topology::kMost)
    fail(Status::kNoMemory, "a window holds at most %zu %s, not %zu", Topology::kMost, what,
         wanted);
}

Topology::Topology(Account& account, size_t cell_capacity, size_t vertex_capacity, bool linked)
    : linked_(linked),
      vertex_of_(account),
      next_(account),
      cell_flags_(account),
      first_corner_(account),
      vertex_flags_(account) {
  growCells(cell_capacity);
  growVertices(vertex_capacity);
}

void Topology::growCells(size_t capacity) {
  checkRoom(capacity, "cells");
  vertex_of_.resize(4 * capacity);
  if (linked_) next_.resize(4 * capacity);
  cell_flags_.resize(capacity);
}

void Topology::growVertices(size_t capacity) {
  checkRoom(capacity, "vertices");
  if (linked_) first_corner_.resize(capacity);
  vertex_flags_.resize(capacity);
}

void Topology::expectCells(size_t first, size_t end) {
  vertex_of_.expect(4 * first, 4 * end);
  if (linked_) next_.expect(4 * first, 4 * end);
  cell_flags_.expect(first, end);
}

void Topology::expectVertices(size_t first, size_t end) {
  if (linked_) first_corner_.expect(first, end);
  vertex_flags_.expect(first, end);
}

uint32_t Topology::addVertex(uint8_t flags) {
  const uint32_t v = vertex_end_++;
  if (linked_) first_corner_[v] = kNone;
  vertex_flags_[v] = flags;
  return v;
}

void Topology::link(uint32_t corner, uint32_t v) {
  const uint32_t first = first_corner_[v];
  if (first == kNone) {
    first_corner_[v] = next_[corner] = corner;
  } else {
    next_[corner] = next_[first];
    next_[first] = corner;
  }
}

uint32_t Topology::cornerOf(uint32_t cell, uint32_t v) const {
  uint32_t corner = 4 * cell;
  while (vertex_of_[corner] != v) ++corner;
  return corner;
}

uint32_t Topology::addCell(const uint32_t corners[4], uint8_t flags) {
  const uint32_t cell = cell_end_++;
  cell_flags_[cell] = flags;
  for (uint32_t j = 0; j < 4; ++j) {
    vertex_of_[4 * size_t{cell} + j] = corners[j];
    if (linked_) link(4 * cell + j, corners[j]);
  }
  ++live_cells_;
  return cell;
}

void Topology::gather(uint32_t v, uint32_t other, Star& star, Star& ring) {
  star.clear();
  ring.clear();
  const uint32_t first = first_corner_[v];
  if (first == kNone) return;
  // `before` trails one step behind; the circle is closed again over each dead corner. The first
  // corner is judged last, when its predecessor is known.
  uint32_t before = first, corner = next_[first];
  for (bool last = false; !last; corner = next_[corner]) {
    last = corner == first;
    if (cell_flags_[corner / 4] & kDead) {
      next_[before] = next_[corner];
      continue;
    }
    before = corner;
    const StarCell cell = starCell(corner);
    (cell.has(other) ? ring : star).add() = cell;
  }
  first_corner_[v] = star.size() + ring.size() ? before : kNone;
}

bool Topology::gatherUpTo(uint32_t v, size_t most, Star& star) const {
  star.clear();
  const uint32_t first = first_corner_[v];
  if (first == kNone) return true;
  uint32_t corner = first;
  for (size_t walked = 0; walked < most; ++walked) {
    if (!(cell_flags_[corner / 4] & kDead)) star.add() = starCell(corner);
    corner = next_[corner];
    if (corner == first) return true;
  }
  return false;
}

void Topology::kill(uint32_t cell) {
  cell_flags_[cell] |= kDead;
  --live_cells_;
}

void Topology::park(uint32_t cell) {
  cell_flags_[cell] |= kParked;
  --live_cells_;
  ++parked_cells_;
}

void Topology::takeBack(uint8_t vertex_flag) {
  for (uint32_t c = 0; c < cell_end_; ++c) unflagCell(c, kParked);
  for (uint32_t v = 0; v < vertex_end_; ++v) vertex_flags_[v] &= static_cast<uint8_t>(~vertex_flag);
  live_cells_ += std::exchange(parked_cells_, 0);
}

void Topology::merge(uint32_t u, uint32_t v, const Stars& stars) {
  first_corner_[u] = first_corner_[v] = kNone;
  for (const StarCell& s : stars.ring) kill(s.cell);
  for (const StarCell& s : stars.u) link(cornerOf(s.cell, u), u);
  for (const StarCell& s : stars.v) {
    const uint32_t corner = cornerOf(s.cell, v);
    vertex_of_[corner] = u;
    link(corner, u);
  }
  vertex_flags_[v] |= kCollapsed;
  vertex_flags_[u] |= vertex_flags_[v] & kOnSheet;
}

}  // namespace tetstream
