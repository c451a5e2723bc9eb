// mesh/topology: the edges of a vertex's link that one cell has: the faces of the boundary round
// the vertex. Depends on vertex_pair.h.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "vertex_pair.h"

namespace tetstream {

// A hash with at least twice as many places as edges.
class LinkEdges {
 public:
  // Forgets all edges; at most so many will be added.
  void start(size_t edges) {
    const size_t places = std::bit_ceil(std::max<size_t>(2 * edges, 2));
    if (places_.size() < places) places_.resize(places);
    std::fill_n(places_.data(), places, 0u);
    if (edges_.size() < edges + 1) edges_.resize(edges + 1);
    shift_ = static_cast<unsigned>(64 - std::countr_zero(places));
    mask_ = places - 1;
    count_ = 0;
  }

  void add(uint32_t from, uint32_t to) {
    const uint64_t pair = pairOf(from, to);
    for (size_t at = pair * uint64_t{0x9e3779b97f4a7c15} >> shift_;; at = (at + 1) & mask_) {
      if (places_[at] == 0) {
        places_[at] = ++count_;
        edges_[count_] = {pair, from, to, true};
        return;
      }
      Edge& known = edges_[places_[at]];
      if (known.pair != pair) continue;
      known.is_single = false;
      return;
    }
  }

  // visit(from, to) for each edge that was added once, in the order of adding.
  template <class Visit>
  void forSingle(Visit visit) const {
    for (size_t i = 1; i <= count_; ++i)
      if (edges_[i].is_single) visit(edges_[i].from, edges_[i].to);
  }

 private:
  struct Edge {
    uint64_t pair;
    uint32_t from, to;
    bool is_single;
  };
  std::vector<uint32_t> places_;  // the number of an edge, from 1 on
  std::vector<Edge> edges_;
  size_t mask_ = 0;
  unsigned shift_ = 63;
  uint32_t count_ = 0;
};

}  // namespace tetstream
