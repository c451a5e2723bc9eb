#include "topology.h"

#include "status.h"

namespace tetstream {

// Corners are numbered with 32 bits.
constexpr size_t kMostCells = (size_t{1} << 30) - 1;

Topology::Topology(Account& account, size_t cell_capacity, size_t vertex_capacity)
    : vertex_of_(account),
      next_(account),
      cell_flags_(account),
      first_corner_(account),
      vertex_flags_(account) {
  growCells(cell_capacity);
  growVertices(vertex_capacity);
}

void Topology::growCells(size_t capacity) {
  if (capacity > kMostCells)
    fail(Status::kNoMemory, "a window holds at most %zu cells, not %zu", kMostCells, capacity);
  vertex_of_.resize(4 * capacity);
  next_.resize(4 * capacity);
  cell_flags_.resize(capacity);
}

void Topology::growVertices(size_t capacity) {
  first_corner_.resize(capacity);
  vertex_flags_.resize(capacity);
}

uint32_t Topology::addVertex(uint8_t flags) {
  const uint32_t v = vertex_end_++;
  first_corner_[v] = kNone;
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

uint32_t Topology::addCell(const uint32_t corners[4], uint8_t flags) {
  const uint32_t cell = cell_end_++;
  cell_flags_[cell] = flags;
  for (uint32_t j = 0; j < 4; ++j) {
    vertex_of_[4 * size_t{cell} + j] = corners[j];
    link(4 * cell + j, corners[j]);
  }
  ++live_cells_;
  return cell;
}

// The face opposite corner j, so that (j, t0, t1, t2) is an even permutation of 0 1 2 3.
static const uint8_t kOpposite[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

void Topology::gather(uint32_t v, Star& star) {
  star.clear();
  const uint32_t first = first_corner_[v];
  if (first == kNone) return;
  // `before` trails one step behind; the circle is closed again over each dead corner. The first
  // corner is judged last, when its predecessor is known.
  uint32_t before = first, corner = next_[first];
  for (bool last = false; !last; corner = next_[corner]) {
    last = corner == first;
    const uint32_t cell = corner / 4, j = corner % 4;
    if (cell_flags_[cell] & kDead) {
      next_[before] = next_[corner];
      continue;
    }
    before = corner;
    const uint32_t* v_of = corners(cell);
    StarCell& s = star.add();
    s.cell = cell;
    s.corner = corner;
    const bool negative = cell_flags_[cell] & kNegative;
    s.t[0] = v_of[kOpposite[j][0]];
    s.t[1] = v_of[kOpposite[j][negative ? 2 : 1]];
    s.t[2] = v_of[kOpposite[j][negative ? 1 : 2]];
  }
  first_corner_[v] = star.size() ? before : kNone;
}

void Topology::kill(uint32_t cell) {
  cell_flags_[cell] |= kDead;
  --live_cells_;
}

void Topology::merge(uint32_t u, uint32_t v, const Star& around_u, const Star& around_v) {
  first_corner_[u] = kNone;
  for (const StarCell& s : around_u)
    if (s.has(v))
      kill(s.cell);
    else
      link(s.corner, u);
  for (const StarCell& s : around_v) {
    if (s.has(u)) continue;
    vertex_of_[s.corner] = u;
    link(s.corner, u);
  }
  first_corner_[v] = kNone;
  vertex_flags_[v] |= kCollapsed;
  vertex_flags_[u] |= vertex_flags_[v] & kBoundary;
}

}  // namespace tetstream
