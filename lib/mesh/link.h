// mesh: whether collapsing an edge keeps the topology of the domain and of its boundary.
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

  // `around_u` and `around_v` as gathered. True if u and v may be merged. Allowed for any edge;
  // for one inside the domain it answers without a test, as said above.
  bool holds(const Topology& mesh, uint32_t u, uint32_t v, const Star& around_u,
             const Star& around_v);

 private:
  static constexpr int kLargestRing = 64;  // bits of a mask; larger rings are refused

  bool ringOf(uint32_t v, const Star& around_u);
  int ringIndex(uint32_t vertex) const;
  bool commonNeighboursInRing(uint32_t u, const Star& around_u, const Star& around_v);
  bool commonEdgesInRing(uint32_t u, uint32_t v, const Star& around_u, const Star& around_v);
  bool noCommonTriangle(uint32_t u, uint32_t v, const Star& around_u, const Star& around_v);
  bool boundaryLinksAgree(uint32_t v, const Star& around_u, const Star& around_v);

  uint32_t ring_[kLargestRing];
  uint64_t ring_edges_[kLargestRing];  // bit j of entry i: a cell u v ring[i] ring[j]
  int ring_size_ = 0;
  Array<uint32_t> neighbours_;
  Array<uint64_t> faces_u_, faces_v_;  // boundary faces as edges of the link
};

// The boundary faces round a vertex whose star is complete, as edges of its link, each a pair of
// vertices low * 2^32 + high, sorted: those that belong to one cell of the star only. Returns
// their number; `edges` grows as needed. `repeated` tells whether any face belongs to more than
// two cells.
size_t boundaryEdgesOfLink(const Star& star, Array<uint64_t>& edges, bool* repeated);

}  // namespace tetstream
