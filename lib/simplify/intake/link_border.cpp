#include "link_border.h"

#include <algorithm>
#include <utility>

#include "turn_weight.h"

namespace tetstream {

// Of each vertex of the link: the weights of the ends of the edges from it less those of the edges
// to it. 0 where there is one back for each.
void LinkBorder::sumEdges(const Star& star) {
  const size_t corners = 3 * star.size();
  if (corner_places_.size() < corners) corner_places_.resize(corners + corners / 2);
  numbers_.start(corners);
  uint32_t* at = corner_places_.data();
  for (const StarCell& s : star) {
    const uint64_t a = turnWeight(s.t[0]), b = turnWeight(s.t[1]), c = turnWeight(s.t[2]);
    for (int k = 0; k < 3; ++k) at[k] = numbers_.placeOf(s.t[k], 0);
    numbers_.valueAt(at[0]) += b - c;
    numbers_.valueAt(at[1]) += c - a;
    numbers_.valueAt(at[2]) += a - b;
    at += 3;
  }
}

// Sorts the edges that may have no other that goes back: both ends have sums other than 0. With
// their directions in the lowest bit, for which there is room: a window has fewer than 2^30
// vertices.
void LinkBorder::listOpen(const Star& star) {
  edges_.resize(3 * star.size());
  size_t count = 0;
  const uint32_t* at = corner_places_.data();
  for (const StarCell& s : star) {
    const bool open[3] = {numbers_.valueAt(at[0]) != 0, numbers_.valueAt(at[1]) != 0,
                          numbers_.valueAt(at[2]) != 0};
    for (int k = 0; k < 3; ++k) {
      const uint64_t a = s.t[k], b = s.t[(k + 1) % 3];
      edges_[count] = a < b ? a << 33 | b << 1 : b << 33 | a << 1 | 1;
      count += open[k] & open[(k + 1) % 3];
    }
    at += 3;
  }
  edges_.resize(count);
  std::sort(edges_.begin(), edges_.end());
}

// Of the sorted edges those that are there once. False if one is there more often than once in
// either direction.
bool LinkBorder::keepSingle() {
  size_t kept = 0;
  for (size_t i = 0, next; i < edges_.size(); i = next) {
    const uint64_t pair = edges_[i] >> 1;
    next = i + 1;
    if (next == edges_.size() || edges_[next] >> 1 != pair) {
      edges_[kept++] = (pair >> 32) << 32 | (pair & 0xffffffffu);
      continue;
    }
    if (edges_[next++] == edges_[i]) return false;
    if (next < edges_.size() && edges_[next] >> 1 == pair) return false;
  }
  edges_.resize(kept);
  return true;
}

// Of the edges that were not listed none is there more than once in a direction if the link has as
// many vertices as a disk with its faces and its border.
bool LinkBorder::find(const Star& star) {
  sumEdges(star);
  listOpen(star);
  if (!keepSingle()) return false;
  return !edges_.empty() && 2 * numbers_.count() == star.size() + edges_.size() + 2;
}

// In a circle every vertex has two others, and walking from one to the next meets all.
bool LinkBorder::isCircle(const std::vector<uint64_t>& edges) {
  const size_t count = edges.size();
  numbers_.start(2 * count);
  ends_.assign(2 * count, kNone);
  const auto put = [this](uint32_t at, uint32_t other) {
    uint32_t* const to = &ends_[2 * size_t{at}];
    const bool fits = to[1] == kNone;
    (to[0] == kNone ? to[0] : to[1]) = other;
    return fits;
  };
  for (uint64_t edge : edges) {
    const uint32_t a = numbers_.numberOf(static_cast<uint32_t>(edge >> 32));
    const uint32_t b = numbers_.numberOf(static_cast<uint32_t>(edge));
    if (numbers_.count() > count || !put(a, b) || !put(b, a)) return false;
  }
  uint32_t before = 0, at = ends_[0];
  size_t walked = 1;
  for (; at != 0; ++walked) {
    const uint32_t* const ends = &ends_[2 * size_t{at}];
    before = std::exchange(at, ends[0] == before ? ends[1] : ends[0]);
  }
  return walked == count;
}

}  // namespace tetstream
