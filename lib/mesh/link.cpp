#include "link.h"

#include <algorithm>
#include <limits>

#include "vertex_pair.h"

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
    int index[2], found = 0;
    for (uint32_t t : s.t) {
      if (t == v) continue;
      int i = ringIndex(t);
      if (i < 0) {
        if (ring_size_ == kLargestRing) return false;
        i = ring_size_++;
        marks_[t] = mark_ + 1 + static_cast<uint32_t>(i);
        ring_[i] = t;
        ring_edges_[i] = 0;
      }
      index[found++] = i;
    }
    ring_edges_[index[0]] |= uint64_t{1} << index[1];
    ring_edges_[index[1]] |= uint64_t{1} << index[0];
  }
  return true;
}

bool LinkCondition::commonNeighboursInRing(const Stars& stars) const {
  for (const StarCell& s : stars.v)
    for (uint32_t t : s.t)
      if (marks_[t] == mark_) return false;
  return true;
}

bool LinkCondition::commonEdgesInRing(const Stars& stars) const {
  uint64_t masks[2][kLargestRing];
  std::fill_n(masks[0], ring_size_, uint64_t{0});
  std::fill_n(masks[1], ring_size_, uint64_t{0});
  const Star* sides[2] = {&stars.u, &stars.v};
  for (int side = 0; side < 2; ++side)
    for (const StarCell& s : *sides[side]) {
      const int r[3] = {ringIndex(s.t[0]), ringIndex(s.t[1]), ringIndex(s.t[2])};
      for (int i = 0; i < 3; ++i) {
        const int a = r[i], b = r[(i + 1) % 3];
        if (a < 0 || b < 0) continue;
        masks[side][a] |= uint64_t{1} << b;
        masks[side][b] |= uint64_t{1} << a;
      }
    }
  for (int i = 0; i < ring_size_; ++i)
    if (masks[0][i] & masks[1][i] & ~ring_edges_[i]) return false;
  return true;
}

static bool sameTriangle(const StarCell& a, const StarCell& b) {
  return b.has(a.t[0]) && b.has(a.t[1]) && b.has(a.t[2]);
}

bool LinkCondition::noCommonTriangle(const Stars& stars) const {
  for (const StarCell& a : stars.u) {
    if (ringIndex(a.t[0]) < 0 || ringIndex(a.t[1]) < 0 || ringIndex(a.t[2]) < 0) continue;
    for (const StarCell& b : stars.v)
      if (sameTriangle(a, b)) return false;
  }
  return true;
}

// The boundary faces round an end, as edges of its link: those of one cell only. Both ends of such
// an edge are on the boundary. Sorted.
static void listBoundaryFaces(const Star& star, const Star& ring, const uint8_t* flags,
                              std::vector<uint64_t>& edges) {
  edges.clear();
  for (const Star* part : {&star, &ring})
    for (const StarCell& s : *part)
      for (int i = 0; i < 3; ++i) {
        const uint32_t a = s.t[i], b = s.t[(i + 1) % 3];
        if (flags[a] & flags[b] & kBoundary) edges.push_back(pairOf(a, b));
      }
  std::sort(edges.begin(), edges.end());
  size_t kept = 0;
  for (size_t i = 0, j; i < edges.size(); i = j) {
    for (j = i + 1; j < edges.size() && edges[j] == edges[i];) ++j;
    if (j - i == 1) edges[kept++] = edges[i];
  }
  edges.resize(kept);
}

bool LinkCondition::boundaryLinksAgree(uint32_t v, const Stars& stars, const uint8_t* flags) {
  listBoundaryFaces(stars.u, stars.ring, flags, faces_u_);
  listBoundaryFaces(stars.v, stars.ring_from_v, flags, faces_v_);
  // The boundary faces that hold both u and v: v in the link of u.
  uint32_t shared[2];
  int shared_count = 0;
  for (uint64_t face : faces_u_) {
    if (lowOf(face) != v && highOf(face) != v) continue;
    if (shared_count == 2) return false;
    shared[shared_count++] = lowOf(face) == v ? highOf(face) : lowOf(face);
  }
  if (shared_count != 2) return false;  // not a boundary edge, or a non-manifold one
  for (uint64_t face : faces_u_) {
    // No face uab beside vab.
    if (std::binary_search(faces_v_.begin(), faces_v_.end(), face)) return false;
    // A boundary neighbour of both makes a boundary face with both.
    for (uint32_t a : {lowOf(face), highOf(face)})
      if (a != v && a != shared[0] && a != shared[1] && holdsVertex(faces_v_, a)) return false;
  }
  return true;
}

bool LinkCondition::holds(End u, End v, const Stars& stars, const uint8_t* flags) {
  if (!u.outside && !v.outside) return true;
  mark(stars);
  if (!findRing(v.vertex, stars.ring)) return false;
  if (!commonNeighboursInRing(stars)) return false;
  if (!commonEdgesInRing(stars)) return false;
  if (!noCommonTriangle(stars)) return false;
  return !(u.outside && v.outside) || boundaryLinksAgree(v.vertex, stars, flags);
}

}  // namespace tetstream
