#include "resolve.h"

#include <algorithm>

namespace tetstream {

static uint64_t mix(uint64_t x) {
  x = (x ^ (x >> 31)) * 0x7fb5d329728ea185ull;
  x = (x ^ (x >> 27)) * 0x81dadef4bc2dd44dull;
  return x ^ (x >> 33);
}

// The link of an inner vertex is closed: each of its edges is there once in each direction. A sum
// of hashes that change sign with the direction is zero then, and otherwise only by a chance of
// 2^-64.
static bool isClosed(const Star& star) {
  uint64_t sum = 0;
  for (const StarCell& s : star)
    for (int i = 0; i < 3; ++i) {
      const uint64_t a = s.t[i], b = s.t[(i + 1) % 3];
      sum += a < b ? mix(a << 32 | b) : -mix(b << 32 | a);
    }
  return sum == 0;
}

template <class S>
void Resolver<S>::resolve(const uint32_t* vertices, size_t count) {
  for (size_t i = 0; i < count; ++i) resolve(vertices[i]);
}

template <class S>
void Resolver<S>::resolve(uint32_t v) {
  Topology& mesh = core_.window.mesh;
  mesh.gather(v, star_);
  if (!isClosed(star_)) resolveBoundary(v);
  if (regions_.differ(star_)) {
    mesh.flagVertex(v, kLocked);
    ++core_.locked.interfaces;
  }
  mesh.flagVertex(v, kResolved);
}

// Two cells on the same side of their common face: both are passed on as they are. (A flat cell has
// no side; it was marked, and its vertices locked, when it was read.)
template <class S>
void Resolver<S>::lockFold(uint32_t a, uint32_t b) {
  Topology& mesh = core_.window.mesh;
  for (const StarCell& s : star_)
    if (s.has(a) && s.has(b) && (mesh.cellFlags(s.cell) & kFlat)) return;
  for (const StarCell& s : star_) {
    if (!s.has(a) || !s.has(b)) continue;
    if (!(mesh.cellFlags(s.cell) & kFolded)) ++core_.report.locked_cells;
    mesh.flagCell(s.cell, kFolded);
    for (int j = 0; j < 4; ++j) mesh.flagVertex(mesh.corners(s.cell)[j], kLocked);
    ++core_.locked.bad_cells;
  }
}

template <class S>
void Resolver<S>::resolveBoundary(uint32_t v) {
  Topology& mesh = core_.window.mesh;
  // Pairs of slots fit 31 bits each: a window has fewer than 2^30 cells, so fewer vertices than
  // 2^31. The lowest bit is the direction.
  if (edges_.size() < 3 * star_.size()) edges_.resize(6 * star_.size());
  size_t count = 0;
  for (const StarCell& s : star_)
    for (int i = 0; i < 3; ++i) {
      const uint64_t a = s.t[i], b = s.t[(i + 1) % 3];
      edges_[count++] = a < b ? a << 33 | b << 1 : b << 33 | a << 1 | 1;
    }
  std::sort(edges_.data(), edges_.data() + count);
  boundary_.clear();
  for (size_t i = 0, j; i < count; i = j) {
    const uint64_t pair = edges_[i] >> 1;
    for (j = i + 1; j < count && edges_[j] >> 1 == pair;) ++j;
    const uint32_t a = static_cast<uint32_t>(pair >> 32), b = static_cast<uint32_t>(pair);
    if (j - i == 1) {
      boundary_.push_back(uint64_t{a} << 32 | b);
      const bool counted = (mesh.vertexFlags(a) | mesh.vertexFlags(b)) & kResolved;
      if (!counted) metric_.addBoundaryFace(v, a, b);
    } else if (j - i == 2) {
      if ((edges_[i] & 1) == (edges_[i + 1] & 1)) lockFold(a, b);
    } else {
      lockNonManifold(v);  // a face of three cells or more
    }
  }
  if (boundary_.empty()) return;
  mesh.flagVertex(v, kBoundary);
  if (!isDisk(boundary_)) lockNonManifold(v);
}

template <class S>
void Resolver<S>::lockNonManifold(uint32_t v) {
  core_.window.mesh.flagVertex(v, kLocked);
  ++core_.locked.non_manifold;
}

// Whether the boundary faces round a vertex form one fan: the edges of the link's boundary make a
// single circle. Each end of each edge is listed with its edge; in a circle every vertex is there
// twice, and walking from edge to edge meets all of them.
template <class S>
bool Resolver<S>::isDisk(const std::vector<uint64_t>& boundary) {
  ends_.clear();
  for (uint64_t edge = 0; edge < boundary.size(); ++edge) {
    ends_.push_back((boundary[edge] >> 32) << 32 | edge);
    ends_.push_back(boundary[edge] << 32 | edge);
  }
  std::sort(ends_.begin(), ends_.end());
  for (size_t i = 0; i < ends_.size(); i += 2) {
    const bool pair = ends_[i] >> 32 == ends_[i + 1] >> 32;
    if (!pair || (i + 2 < ends_.size() && ends_[i + 2] >> 32 == ends_[i] >> 32)) return false;
  }
  uint64_t edge = 0, at = boundary[0] >> 32;
  size_t walked = 0;
  do {
    const uint64_t other =
        boundary[edge] >> 32 == at ? boundary[edge] & 0xffffffffu : boundary[edge] >> 32;
    const auto first = std::lower_bound(ends_.begin(), ends_.end(), other << 32);
    const uint64_t next = first[0] & 0xffffffffu;
    edge = next != edge ? next : first[1] & 0xffffffffu;
    at = other;
    ++walked;
  } while (edge != 0 && walked <= boundary.size());
  return walked == boundary.size();
}

template class Resolver<float>;
template class Resolver<double>;

}  // namespace tetstream
