// mesh/topology: whether collapsing an edge keeps the topology of the domain and of its boundary.
// Depends on topology.h.
#pragma once

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
  // without a test, as said above.
  bool holds(End u, End v, const Stars& stars);

 private:
  // The ring's vertices are numbered from 1 on, as bits of a mask; all others have the number 0,
  // so that nothing branches on who is in the ring. Larger rings are refused.
  static constexpr uint32_t kLargestRing = 63;

  // What an end has with the vertices of the ring.
  struct Side {
    uint64_t joined[kLargestRing + 1];  // bit j of entry i: a cell with both, but not the other end
    uint64_t turn[kLargestRing + 1];    // 0 where the cells round the edge to i close a circle
  };

  void mark(const Stars& stars);
  bool findRing(uint32_t v, const Star& ring);
  uint32_t numberOf(uint32_t vertex) const {
    const uint32_t m = marks_[vertex];
    return m > mark_ ? m - mark_ : 0;
  }
  bool commonNeighboursInRing(const Stars& stars) const;
  void join(const Star& star, Side& side);
  bool commonEdgesInRing() const;
  bool noCommonTriangle(const Stars& stars) const;
  void addTurns(const Star& cells, Side& side) const;
  bool boundaryLinksAgree(const Stars& stars);

  // Per vertex: mark_ for a neighbour of u, mark_ + i for vertex i of the ring, less for others.
  Array<uint32_t> marks_;
  uint32_t mark_ = 0;
  uint32_t ring_size_ = 0;
  uint32_t ring_cells_[kLargestRing + 1];   // that vertex i is in
  uint64_t ring_joined_[kLargestRing + 1];  // bit j of entry i: a cell with both ends and both
  Side u_, v_;
  bool any_inside_ = false;  // a cell of u has its three other vertices in the ring
};

}  // namespace tetstream
