#include "reconnect.h"

#include <algorithm>
#include <utility>

namespace tetstream {

constexpr double kNotKnown = -2;

template <class S>
void Reconnector<S>::start(bool may_repeat) {
  may_repeat_ = may_repeat;
  if (thinness_.size() < patch_.cellEnd()) thinness_.resize(patch_.cellEnd() + 1024);
  std::fill_n(thinness_.data(), patch_.cellEnd(), kNotKnown);
}

template <class S>
void Reconnector<S>::replace(const Reconnection& r, uint32_t* slots) {
  patch_.replace(r.gone, r.gone_count, r.made, r.made_count, slots);
  for (uint32_t m = 0; m < r.made_count; ++m) thinness_[slots[m]] = kNotKnown;
}

template <class S>
void Reconnector<S>::measureFour(const uint32_t* cells) {
  uint32_t corners[kThinLanes][4];
  double found[kThinLanes];
  for (size_t i = 0; i < kThinLanes; ++i) patch_.cornersOf(cells[i], corners[i]);
  thinnessAt(corners, found);
  for (size_t i = 0; i < kThinLanes; ++i) thinness_[cells[i]] = found[i];
}

template <class S>
double Reconnector<S>::thinnessOfCell(uint32_t c) {
  if (thinness_[c] == kNotKnown) {
    double p[4][3];
    for (uint32_t k = 0; k < 4; ++k)
      for (uint32_t i = 0; i < 3; ++i)
        p[k][i] = static_cast<double>(patch_.values(patch_.vertexOf(c, k))[i]);
    thinness_[c] = thinness(p);
  }
  return thinness_[c];
}

template <class S>
void Reconnector<S>::addGone(uint32_t c, Reconnection& out) {
  out.gone[out.gone_count++] = c;
  out.before = std::max(out.before, thinnessOfCell(c));
}

// Of vertices that are not owned, whether one may be somewhere already that is about to be made.
// Both would begin in the same direction: cells overlap at every one of the vertices, which then
// are those of cells that fold, and locked, or are not final. Or there is a gap between both, which
// begins and ends at vertices that are locked for it.
template <class S>
bool Reconnector<S>::mayBeThere(const uint32_t* vertices, size_t count) const {
  return may_repeat_ && std::none_of(vertices, vertices + count,
                                     [&](uint32_t v) { return patch_.isFreeElsewhere(v); });
}

// The patch knows all cells of owned vertices.
template <class S>
bool Reconnector<S>::hasEdge(uint32_t a, uint32_t b) {
  if (a >= patch_.ownedEnd()) std::swap(a, b);
  const uint32_t ends[2] = {a, b};
  if (a >= patch_.ownedEnd()) return mayBeThere(ends, 2);
  patch_.gather(a, b, star_, ring_);
  return ring_.size() > 0;
}

template <class S>
bool Reconnector<S>::hasFace(const uint32_t corners[3]) {
  const uint32_t* owned = std::min_element(corners, corners + 3);
  if (*owned >= patch_.ownedEnd()) return mayBeThere(corners, 3);
  const auto k = static_cast<size_t>(owned - corners);
  patch_.gather(*owned, corners[(k + 1) % 3], star_, ring_);
  for (const StarCell& s : ring_)
    if (s.has(corners[(k + 2) % 3])) return true;
  return false;
}

template <class S>
bool Reconnector<S>::removeFace(uint32_t c, uint32_t j, Reconnection& out, double least_gain) {
  out = {};
  const StarCell above = patch_.starCell(4 * c + j);  // d above the face t
  const uint32_t d = patch_.vertexOf(c, j), *t = above.t;
  int owned = 0;
  while (owned < 3 && t[owned] >= patch_.ownedEnd()) ++owned;
  if (owned == 3) return false;
  patch_.gather(t[owned], t[(owned + 1) % 3], star_, ring_);
  uint32_t beyond = kNone, e = kNone;
  for (const StarCell& s : ring_)
    if (s.cell != c && s.has(t[(owned + 2) % 3])) {
      beyond = s.cell;
      for (uint32_t x : s.t)
        if (x != t[(owned + 1) % 3] && x != t[(owned + 2) % 3]) e = x;
    }
  if (beyond == kNone) return false;
  addGone(c, out);
  addGone(beyond, out);
  // (d, t0, t1, t2) is positive; in it e, beyond the face, takes the place of each t in turn.
  const uint32_t made[kThinLanes][4] = {
      {d, t[0], t[1], e}, {d, t[1], t[2], e}, {d, t[2], t[0], e}, {d, t[0], t[1], e}};
  double found[kThinLanes];
  thinnessAt(made, found);
  out.after = std::max({found[0], found[1], found[2]});
  while (out.made_count < 3) {
    std::copy_n(made[out.made_count], 4, out.made[out.made_count]);
    ++out.made_count;
  }
  if (!(out.after < out.before - least_gain) || hasEdge(d, e)) out.after = kTurned;
  return true;
}

// The ring's vertices in their circle: of the cells (u, v, a, b) it holds a before b. False if it
// is open.
template <class S>
bool Reconnector<S>::orderRing(uint32_t v, uint32_t* ring) const {
  const size_t n = ring_.size();
  uint32_t from[Reconnection::kMostRing], to[Reconnection::kMostRing];
  for (size_t i = 0; i < n; ++i) {
    const uint32_t* t = ring_[i].t;
    const int at = t[0] == v ? 0 : t[1] == v ? 1 : 2;
    from[i] = t[(at + 1) % 3];
    to[i] = t[(at + 2) % 3];
  }
  uint32_t next = from[0];
  for (size_t i = 0; i < n; ++i) {
    ring[i] = next;
    const auto place = static_cast<size_t>(std::find(from, from + n, next) - from);
    if (place == n) return false;
    next = to[place];
    if (next == from[0] && i + 1 < n) return false;
  }
  return next == from[0];
}

// Of the ring's vertices from place i to place k: how bad the worst cell is of the best
// triangulation, and the third vertex of its triangle at both ends.
template <class S>
struct Reconnector<S>::Chains {
  static constexpr uint32_t kMost = Reconnection::kMostRing;
  explicit Chains(uint32_t vertices) : count(vertices) {
    for (uint32_t i = 0; i + 1 < count; ++i) worst[i][i + 1] = -1;
  }
  uint32_t count;
  double worst[kMost][kMost] = {};
  uint32_t middle[kMost][kMost];
};

// Chains of the length, from those that are shorter. Two triangles at a time are measured, and none
// whose parts are too bad.
template <class S>
void Reconnector<S>::addTriangles(uint32_t u, uint32_t v, const uint32_t* ring, uint32_t length,
                                  double limit, Chains& chains) const {
  struct Triangle {
    uint32_t i, j, k;
    double parts;
  } triangles[Chains::kMost * Chains::kMost];
  uint32_t count = 0;
  for (uint32_t i = 0, k = length; k < chains.count; ++i, ++k) {
    chains.worst[i][k] = kTurned;
    for (uint32_t j = i + 1; j < k; ++j) {
      const double parts = std::max(chains.worst[i][j], chains.worst[j][k]);
      if (parts < limit) triangles[count++] = {i, j, k, parts};
    }
  }
  for (uint32_t first = 0; first < count; first += 2) {
    const uint32_t last = std::min(first + 1, count - 1);
    uint32_t cells[kThinLanes][4];
    for (uint32_t t = 0; t < 2; ++t) {
      const Triangle& at = triangles[t == 0 ? first : last];
      const uint32_t lower[4] = {u, ring[at.i], ring[at.j], ring[at.k]};
      const uint32_t upper[4] = {v, ring[at.i], ring[at.k], ring[at.j]};
      std::copy_n(lower, 4, cells[2 * t]);
      std::copy_n(upper, 4, cells[2 * t + 1]);
    }
    double found[kThinLanes];
    thinnessAt(cells, found);
    for (uint32_t t = 0; first + t <= last; ++t) {
      const auto [i, j, k, parts] = triangles[first + t];
      const double w = std::max({parts, found[2 * t], found[2 * t + 1]});
      if (w >= chains.worst[i][k]) continue;
      chains.worst[i][k] = w;
      chains.middle[i][k] = j;
    }
  }
}

// The triangulation of the ring whose worst cell is best, by dynamic programming over its chains
// (Klincsek 1980): each triangle makes a cell with u and one with v.
template <class S>
void Reconnector<S>::triangulate(uint32_t u, uint32_t v, const uint32_t* ring, double least_gain,
                                 Reconnection& out) {
  const uint32_t n = out.gone_count;
  const double limit = out.before - least_gain;
  Chains found(n);
  for (uint32_t length = 2; length < n; ++length) addTriangles(u, v, ring, length, limit, found);
  out.after = found.worst[0][n - 1];
  if (!(out.after < limit) || (n == 3 && hasFace(ring))) {
    out.after = kTurned;
    return;
  }
  uint32_t chains[Chains::kMost][2] = {{0, n - 1}};
  for (uint32_t count = 1; count > 0;) {
    const uint32_t i = chains[--count][0], k = chains[count][1], j = found.middle[i][k];
    const uint32_t cells[2][4] = {{u, ring[i], ring[j], ring[k]}, {v, ring[i], ring[k], ring[j]}};
    for (const auto& cell : cells) std::copy_n(cell, 4, out.made[out.made_count++]);
    for (const auto& [begin, end] : {std::pair(i, j), std::pair(j, k)}) {
      if (end - begin < 2) continue;
      if (hasEdge(ring[begin], ring[end])) {
        out.after = kTurned;
        return;
      }
      chains[count][0] = begin;
      chains[count++][1] = end;
    }
  }
}

template <class S>
bool Reconnector<S>::removeEdge(uint32_t c, uint32_t i, uint32_t j, Reconnection& out,
                                uint32_t most_ring, double least_gain) {
  out = {};
  uint32_t u = patch_.vertexOf(c, i), v = patch_.vertexOf(c, j);
  if (u >= patch_.ownedEnd()) std::swap(u, v);
  if (u >= patch_.ownedEnd()) return false;
  patch_.gather(u, v, star_, ring_);
  uint32_t ring[Reconnection::kMostRing];
  if (ring_.size() < 3 || ring_.size() > most_ring || !orderRing(v, ring)) return false;
  for (const StarCell& s : ring_) addGone(s.cell, out);
  triangulate(u, v, ring, least_gain, out);
  return true;
}

template class Reconnector<float>;
template class Reconnector<double>;

}  // namespace tetstream
