#include "reconnect.h"

#include <algorithm>
#include <utility>

namespace tetstream {

constexpr double kNotKnown = -2;

template <class S>
void Reconnector<S>::start() {
  if (thinness_.size() < patch_.cellEnd()) thinness_.resize(patch_.cellEnd() + 1024);
  std::fill_n(thinness_.data(), patch_.cellEnd(), kNotKnown);
}

template <class S>
void Reconnector<S>::replace(const Reconnection& r, uint32_t* slots) {
  patch_.replace(r.gone, r.gone_count, r.made, r.made_count, slots);
  for (uint32_t m = 0; m < r.made_count; ++m) thinness_[slots[m]] = kNotKnown;
}

template <class S>
double Reconnector<S>::thinnessAt(const uint32_t corners[4]) const {
  double p[4][3];
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) p[k][i] = static_cast<double>(patch_.values(corners[k])[i]);
  return thinness(p);
}

template <class S>
double Reconnector<S>::thinnessOfCell(uint32_t c) {
  if (thinness_[c] == kNotKnown) {
    const uint32_t corners[4] = {patch_.vertexOf(c, 0), patch_.vertexOf(c, 1),
                                 patch_.vertexOf(c, 2), patch_.vertexOf(c, 3)};
    thinness_[c] = thinnessAt(corners);
  }
  return thinness_[c];
}

template <class S>
void Reconnector<S>::addGone(uint32_t c, Reconnection& out) {
  out.gone[out.gone_count++] = c;
  out.before = std::max(out.before, thinnessOfCell(c));
}

// As far as the patch knows: all cells of owned vertices.
template <class S>
bool Reconnector<S>::hasEdge(uint32_t a, uint32_t b) {
  if (a >= patch_.ownedEnd()) std::swap(a, b);
  if (a >= patch_.ownedEnd()) return false;
  patch_.gather(a, b, star_, ring_);
  return ring_.size() > 0;
}

template <class S>
bool Reconnector<S>::hasFace(const uint32_t corners[3]) {
  const uint32_t* owned = std::min_element(corners, corners + 3);
  if (*owned >= patch_.ownedEnd()) return false;
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
  out.after = -1;
  for (int k = 0; k < 3; ++k) {
    // (d, t0, t1, t2) is positive; in it e, beyond the face, takes the place of each t in turn.
    const uint32_t made[4] = {d, t[k], t[(k + 1) % 3], e};
    std::copy_n(made, 4, out.made[out.made_count++]);
    out.after = std::max(out.after, thinnessAt(made));
    if (out.after >= out.before - least_gain) return true;
  }
  if (hasEdge(d, e)) out.after = kTurned;
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

// The triangulation of the ring whose worst cell is best, by dynamic programming over its chains
// (Klincsek 1980): each triangle makes a cell with u and one with v.
template <class S>
void Reconnector<S>::triangulate(uint32_t u, uint32_t v, const uint32_t* ring, double least_gain,
                                 Reconnection& out) {
  constexpr uint32_t kMost = Reconnection::kMostRing;
  const uint32_t n = out.gone_count;
  const double limit = out.before - least_gain;
  double worst[kMost][kMost] = {};
  uint32_t middle[kMost][kMost];
  const auto best = [&](uint32_t i, uint32_t k) {
    worst[i][k] = kTurned;
    for (uint32_t j = i + 1; j < k; ++j) {
      double w = std::max(worst[i][j], worst[j][k]);
      const uint32_t lower[4] = {u, ring[i], ring[j], ring[k]};
      const uint32_t upper[4] = {v, ring[i], ring[k], ring[j]};
      if (w < limit) w = std::max(w, thinnessAt(lower));
      if (w < limit) w = std::max(w, thinnessAt(upper));
      if (w >= worst[i][k]) continue;
      worst[i][k] = w;
      middle[i][k] = j;
    }
  };
  for (uint32_t i = 0; i + 1 < n; ++i) worst[i][i + 1] = -1;
  for (uint32_t length = 2; length < n; ++length)
    for (uint32_t i = 0; i + length < n; ++i) best(i, i + length);
  out.after = worst[0][n - 1];
  if (out.after < limit && n == 3 && hasFace(ring)) out.after = kTurned;
  if (!(out.after < limit)) return;
  uint32_t chains[kMost][2] = {{0, n - 1}};
  for (uint32_t count = 1; count > 0;) {
    const uint32_t i = chains[--count][0], k = chains[count][1], j = middle[i][k];
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
