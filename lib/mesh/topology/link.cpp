#include "link.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "turn_weight.h"

namespace tetstream {

LinkCondition::LinkCondition(Account& account) : marks_(account) {}

// Marks stay as they are; a new edge has higher ones.
void LinkCondition::mark(const Stars& stars) {
  uint32_t last = 0;
  for (const Star* star : {&stars.ring, &stars.u, &stars.v})
    for (const StarCell& s : *star) last = std::max({last, s.t[0], s.t[1], s.t[2]});
  const size_t before = marks_.size();
  if (last >= before) {
    marks_.resize(last + last / 4 + 1024);
    std::fill(marks_.data() + before, marks_.data() + marks_.size(), 0u);
  }
  mark_ += kLargestRing + 1;
  if (mark_ > std::numeric_limits<uint32_t>::max() - 2 * kLargestRing) {
    std::fill_n(marks_.data(), marks_.size(), 0u);
    mark_ = kLargestRing + 1;
  }
  for (const StarCell& s : stars.u)
    for (uint32_t t : s.t) marks_[t] = mark_;
}

// Collects the ring of uv and its edges from the cells that hold both; false if it is too large.
bool LinkCondition::findRing(uint32_t v, const Star& ring) {
  ring_size_ = 0;
  for (const StarCell& s : ring) {
    uint32_t number[2], found = 0;
    for (uint32_t t : s.t) {
      if (t == v) continue;
      uint32_t i = numberOf(t);
      if (i == 0) {
        if (ring_size_ == kLargestRing) return false;
        i = ++ring_size_;
        marks_[t] = mark_ + i;
        ring_cells_[i] = 0;
        ring_joined_[i] = 0;
      }
      ++ring_cells_[i];
      number[found++] = i;
    }
    ring_joined_[number[0]] |= uint64_t{1} << number[1];
    ring_joined_[number[1]] |= uint64_t{1} << number[0];
  }
  return true;
}

bool LinkCondition::commonNeighboursInRing(const Stars& stars) const {
  for (const StarCell& s : stars.v) {
    const uint32_t a = marks_[s.t[0]], b = marks_[s.t[1]], c = marks_[s.t[2]];
    if ((a == mark_) | (b == mark_) | (c == mark_)) return false;
  }
  return true;
}

void LinkCondition::join(const Star& star, Side& side) {
  std::fill_n(side.joined, ring_size_ + 1, uint64_t{0});
  for (const StarCell& s : star) {
    const uint32_t a = numberOf(s.t[0]), b = numberOf(s.t[1]), c = numberOf(s.t[2]);
    const uint64_t bits = uint64_t{1} << a | uint64_t{1} << b | uint64_t{1} << c;
    side.joined[a] |= bits;
    side.joined[b] |= bits;
    side.joined[c] |= bits;
    any_inside_ |= (a != 0) & (b != 0) & (c != 0);
  }
}

bool LinkCondition::commonEdgesInRing() const {
  for (uint32_t i = 1; i <= ring_size_; ++i) {
    const uint64_t known = ring_joined_[i] | uint64_t{1} << i | 1;
    if (u_.joined[i] & v_.joined[i] & ~known) return false;
  }
  return true;
}

static bool sameTriangle(const StarCell& a, const StarCell& b) {
  return b.has(a.t[0]) && b.has(a.t[1]) && b.has(a.t[2]);
}

bool LinkCondition::noCommonTriangle(const Stars& stars) const {
  for (const StarCell& a : stars.u) {
    if (!numberOf(a.t[0]) || !numberOf(a.t[1]) || !numberOf(a.t[2])) continue;
    for (const StarCell& b : stars.v)
      if (sameTriangle(a, b)) return false;
  }
  return true;
}

// In the link of an end the triangles round a vertex a go from b to c, on to d, and so forth. Ends
// with several fans round a do not come here, they are locked.
void LinkCondition::addTurns(const Star& cells, Side& side) const {
  for (const StarCell& s : cells) {
    const uint64_t a = turnWeight(s.t[0]), b = turnWeight(s.t[1]), c = turnWeight(s.t[2]);
    side.turn[numberOf(s.t[0])] += c - b;
    side.turn[numberOf(s.t[1])] += a - c;
    side.turn[numberOf(s.t[2])] += b - a;
  }
}

// Of a vertex r of the ring the edges ur and vr may both be of the boundary only where the face uvr
// is, too: it has one cell. That must be so of two, or uv is inside the domain or non-manifold. Of
// those two the faces to u and to v are no boundary faces both, unless nothing but the cell of all
// four is there.
bool LinkCondition::boundaryLinksAgree(const Stars& stars) {
  std::fill_n(u_.turn, ring_size_ + 1, uint64_t{0});
  std::fill_n(v_.turn, ring_size_ + 1, uint64_t{0});
  addTurns(stars.u, u_);
  addTurns(stars.ring, u_);
  addTurns(stars.v, v_);
  addTurns(stars.ring_from_v, v_);
  uint32_t shared[2], shared_count = 0;
  for (uint32_t i = 1; i <= ring_size_; ++i) {
    if (ring_cells_[i] != 1) {
      if ((u_.turn[i] != 0) & (v_.turn[i] != 0)) return false;
    } else {
      if (shared_count == 2) return false;
      shared[shared_count++] = i;
    }
  }
  if (shared_count != 2) return false;
  const uint64_t other = uint64_t{1} << shared[1];
  const bool in_one_cell = ring_joined_[shared[0]] & other;
  return !in_one_cell || ((u_.joined[shared[0]] | v_.joined[shared[0]]) & other);
}

bool LinkCondition::holds(End u, End v, const Stars& stars) {
  if (!u.outside && !v.outside) return true;
  mark(stars);
  if (!findRing(v.vertex, stars.ring)) return false;
  if (!commonNeighboursInRing(stars)) return false;
  any_inside_ = false;
  join(stars.v, v_);
  const bool any_of_v = std::exchange(any_inside_, false);
  join(stars.u, u_);
  if (!commonEdgesInRing()) return false;
  if (any_of_v && any_inside_ && !noCommonTriangle(stars)) return false;
  return !(u.outside && v.outside) || boundaryLinksAgree(stars);
}

}  // namespace tetstream
