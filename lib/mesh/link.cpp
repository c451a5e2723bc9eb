#include "link.h"

#include <algorithm>

namespace tetstream {

static uint64_t pairOf(uint32_t a, uint32_t b) {
  return a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a;
}

static uint32_t lowOf(uint64_t pair) {
  return static_cast<uint32_t>(pair >> 32);
}
static uint32_t highOf(uint64_t pair) {
  return static_cast<uint32_t>(pair);
}

size_t boundaryEdgesOfLink(const Star& star, Array<uint64_t>& edges, bool* repeated) {
  if (edges.size() < 3 * star.size()) edges.resize(std::max<size_t>(3 * star.size(), 256));
  size_t count = 0;
  for (const StarCell& s : star)
    for (int i = 0; i < 3; ++i) edges[count++] = pairOf(s.t[i], s.t[(i + 1) % 3]);
  std::sort(edges.data(), edges.data() + count);
  size_t kept = 0;
  *repeated = false;
  for (size_t i = 0; i < count;) {
    size_t j = i + 1;
    while (j < count && edges[j] == edges[i]) ++j;
    if (j - i == 1) edges[kept++] = edges[i];
    if (j - i > 2) *repeated = true;
    i = j;
  }
  return kept;
}

LinkCondition::LinkCondition(Account& account)
    : neighbours_(account, 256), faces_u_(account, 256), faces_v_(account, 256) {}

int LinkCondition::ringIndex(uint32_t vertex) const {
  for (int i = 0; i < ring_size_; ++i)
    if (ring_[i] == vertex) return i;
  return -1;
}

// Collects the ring of uv and its edges from the cells that hold both; false if it is too large.
bool LinkCondition::ringOf(uint32_t v, const Star& around_u) {
  ring_size_ = 0;
  for (const StarCell& s : around_u) {
    if (!s.has(v)) continue;
    int index[2], found = 0;
    for (uint32_t t : s.t) {
      if (t == v) continue;
      int i = ringIndex(t);
      if (i < 0) {
        if (ring_size_ == kLargestRing) return false;
        i = ring_size_++;
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

bool LinkCondition::commonNeighboursInRing(uint32_t u, const Star& around_u, const Star& around_v) {
  if (neighbours_.size() < 3 * around_u.size()) neighbours_.resize(3 * around_u.size());
  size_t count = 0;
  for (const StarCell& s : around_u)
    for (uint32_t t : s.t) neighbours_[count++] = t;
  uint32_t* const end = neighbours_.data() + count;
  std::sort(neighbours_.data(), end);
  for (const StarCell& s : around_v)
    for (uint32_t t : s.t)
      if (t != u && ringIndex(t) < 0 && std::binary_search(neighbours_.data(), end, t))
        return false;
  return true;
}

bool LinkCondition::commonEdgesInRing(uint32_t u, uint32_t v, const Star& around_u,
                                      const Star& around_v) {
  uint64_t masks[2][kLargestRing] = {};
  const Star* stars[2] = {&around_u, &around_v};
  const uint32_t other[2] = {v, u};
  for (int side = 0; side < 2; ++side)
    for (const StarCell& s : *stars[side])
      for (int i = 0; i < 3; ++i) {
        const uint32_t a = s.t[i], b = s.t[(i + 1) % 3];
        if (a == other[side] || b == other[side]) continue;
        const int ia = ringIndex(a), ib = ringIndex(b);
        if (ia < 0 || ib < 0) continue;
        masks[side][ia] |= uint64_t{1} << ib;
        masks[side][ib] |= uint64_t{1} << ia;
      }
  for (int i = 0; i < ring_size_; ++i)
    if (masks[0][i] & masks[1][i] & ~ring_edges_[i]) return false;
  return true;
}

static bool sameTriangle(const StarCell& a, const StarCell& b) {
  return b.has(a.t[0]) && b.has(a.t[1]) && b.has(a.t[2]);
}

bool LinkCondition::noCommonTriangle(uint32_t u, uint32_t v, const Star& around_u,
                                     const Star& around_v) {
  for (const StarCell& a : around_u) {
    if (a.has(v) || ringIndex(a.t[0]) < 0 || ringIndex(a.t[1]) < 0 || ringIndex(a.t[2]) < 0)
      continue;
    for (const StarCell& b : around_v)
      if (!b.has(u) && sameTriangle(a, b)) return false;
  }
  return true;
}

bool LinkCondition::boundaryLinksAgree(uint32_t v, const Star& around_u, const Star& around_v) {
  bool repeated;
  const size_t count_u = boundaryEdgesOfLink(around_u, faces_u_, &repeated);
  const size_t count_v = boundaryEdgesOfLink(around_v, faces_v_, &repeated);
  const uint64_t *fu = faces_u_.data(), *fv = faces_v_.data();
  // The boundary faces that hold both u and v: v in the link of u.
  uint32_t shared[2];
  int shared_count = 0;
  for (size_t i = 0; i < count_u; ++i) {
    if (lowOf(fu[i]) != v && highOf(fu[i]) != v) continue;
    if (shared_count == 2) return false;
    shared[shared_count++] = lowOf(fu[i]) == v ? highOf(fu[i]) : lowOf(fu[i]);
  }
  if (shared_count != 2) return false;  // not a boundary edge, or a non-manifold one
  // No face uab beside vab.
  for (size_t i = 0; i < count_u; ++i)
    if (std::binary_search(fv, fv + count_v, fu[i])) return false;
  // A boundary neighbour of both makes a boundary face with both.
  if (neighbours_.size() < 2 * count_v) neighbours_.resize(2 * count_v);
  uint32_t* const end = neighbours_.data() + 2 * count_v;
  for (size_t j = 0; j < count_v; ++j) {
    neighbours_[2 * j] = lowOf(fv[j]);
    neighbours_[2 * j + 1] = highOf(fv[j]);
  }
  std::sort(neighbours_.data(), end);
  for (size_t i = 0; i < count_u; ++i)
    for (uint32_t a : {lowOf(fu[i]), highOf(fu[i])}) {
      if (a == v || a == shared[0] || a == shared[1]) continue;
      if (std::binary_search(neighbours_.data(), end, a)) return false;
    }
  return true;
}

bool LinkCondition::holds(const Topology& mesh, uint32_t u, uint32_t v, const Star& around_u,
                          const Star& around_v) {
  const bool u_outside = mesh.vertexFlags(u) & kBoundary,
             v_outside = mesh.vertexFlags(v) & kBoundary;
  if (!u_outside && !v_outside) return true;
  if (!ringOf(v, around_u)) return false;
  if (!commonNeighboursInRing(u, around_u, around_v)) return false;
  if (!commonEdgesInRing(u, v, around_u, around_v)) return false;
  if (!noCommonTriangle(u, v, around_u, around_v)) return false;
  return !(u_outside && v_outside) || boundaryLinksAgree(v, around_u, around_v);
}

}  // namespace tetstream
