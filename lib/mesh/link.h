// mesh: whether collapsing an edge keeps the topology of the domain and of its boundary.
// Depends on topology.h.
#pragma once

#include <vector>

#include "topology.h"

namespace tetstream {

// The link condition for 3-complexes with boundary (Dey, Edelsbrunner, Guha, Nekhayev 1999): with
// the boundary coned to a point w, the collapse of uv keeps the topology if
// Lk(u) n Lk(v) = Lk(uv). Taken apart over vertices, edges and triangles:
//   vertices   a common neighbour of u and v lies in the ring of uv; if both are on the boundary,
//              w does, so uv is a boundary edge;
//   edges      an edge ab in both links makes a cell uvab; if ua and va are boundary edges (wa in
//              both links), uva is a boundary face;
//   triangles  no triangle is in both links: neither abc, nor wab, that is no two boundary faces
//              uab and vab.
//
// An edge with both ends inside the domain needs no test when, as is checked, every cell round the
// merged vertex keeps its orientation: the stars' union keeps its boundary, the new cells are the
// cones over that boundary with all volumes positive, so they cover each point of it exactly once
// (the degree of the map is 1), which leaves no room for a second sheet.
class LinkCondition {
 public:
  explicit LinkCondition(Account& account);

  // An end and whether it is on the boundary of the domain.
  struct End {
    uint32_t vertex;
    bool outside;
  };
  // True if the ends may be merged. Allowed for any edge; for one inside the domain it answers
  // without a test, as said above. `flags` of all vertices of the stars: kBoundary is set at least
  // for those of the boundary faces round u and v.
  bool holds(End u, End v, const Stars& stars, const uint8_t* flags);

 private:
  static constexpr int kLargestRing = 64;  // bits of a mask; larger rings are refused

  void mark(const Stars& stars);
  bool findRing(uint32_t v, const Star& ring);
  int ringIndex(uint32_t vertex) const {
    const uint32_t m = marks_[vertex];
    return m > mark_ ? static_cast<int>(m - mark_ - 1) : -1;
  }
  bool commonNeighboursInRing(const Stars& stars) const;
  bool commonEdgesInRing(const Stars& stars) const;
  bool noCommonTriangle(const Stars& stars) const;
  bool boundaryLinksAgree(uint32_t v, const Stars& stars, const uint8_t* flags);

  // Per vertex: mark_ for a neighbour of u, mark_ + 1 + i for vertex i of the ring, less for
  // others.
  Array<uint32_t> marks_;
  uint32_t mark_ = 0;
  uint32_t ring_[kLargestRing];
  uint64_t ring_edges_[kLargestRing];  // bit j of entry i: a cell u v ring[i] ring[j]
  int ring_size_ = 0;
  std::vector<uint64_t> faces_u_, faces_v_;  // boundary faces as edges of the link
};

}  // namespace tetstream
