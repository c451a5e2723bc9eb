// mesh/topology: whether collapsing an edge keeps the topology of what is embedded in the cells:
// interfaces of regions, labelled faces, and curves. Depends on topology.h, embedded.h. Beside
// link.h, which asks for that of the domain and its boundary.
#pragma once

#include <vector>

#include "embedded.h"
#include "topology.h"
#include "vertex_pair.h"

namespace tetstream {

// The cells are those of the domain and, outside, the cones from a point w over the boundary's
// faces, so that the link of every vertex that may move is a sphere. Three complexes of falling
// dimension are embedded: the sheets X2, all faces between cells of different labels (the outside
// is one) and all labelled faces, which may lie inside a region and end there; the curves X1, edges
// of sheets, among them every edge at which other than two faces of X2 meet, as where one ends, or
// two of different labels; the corners X0. A vertex that may move is one of
//   inside   it is in no face of X2;
//   sheet    X2 meets its link in one circle, no edge of X1 is there;
//   curve    two edges of X1 are there; X2 meets its link in arcs from the one to the other, one
//            arc where a sheet ends.
// Everything else is a corner, and locked. u and v may be merged if
//   (3) Lk(u) n Lk(v) = Lk(uv) among the cells (link.h), and
//   (2) where both are on sheets: the same in X2, and if one of them is of the kind sheet, uv is in
//       X2;
//   (1) where both are on curves: uv is in X1, and no vertex is joined to both by edges of X1.
//
// Folds that nobody asked for (curves.h) are taken as edges of X1 where that only forbids more. A
// vertex that is on no other edge of X1 is of the kind sheet, and uv being a fold in X2 is enough
// for it, but not for two that are on others.
//
// Proof that this suffices. Let u be the one of the lower kind, S the link of v, P its pattern:
// the labels of its triangles, with X2 and X1 cut by S as labelled arcs and nodes between them. The
// neighbourhood of v is the cone over (S, P). By (3) the two stars make up a ball, the collapse
// makes it the cone over its boundary S', and S' is S with the disk D = star of u in S replaced by
// another, D' = the part of the link of u off v, with the same rim Lk(uv). So it is enough that the
// new pattern P' is P up to a homeomorphism of spheres: then the ball with all that is embedded is
// mapped to the new one, its boundary fixed. The label of a triangle of D' is that of the cell at
// u.
//   u inside: D and D' have one label, the same, and no arc inside; on the rim all is as it was: of
//             an edge that was an arc, by a face at v, the one face that is left has the label.
//   u sheet:  as uv is in X2, P enters D at u and leaves it as two edges, to a and b, with
//             Lk(uv) n X2 = {a, b}. In D', P' is the circle of u without v: one arc from a to b.
//             By (2) no edge of the rim is in the links of both, and no vertex but a and b: the
//             arc touches nothing of P outside D but in its ends, and can be pushed off the rim.
//             So one arc is replaced by another, with the same labels beside it and, since no edge
//             of X1 is at u, its own. (Any two arcs in a disk that have their ends on its rim are
//             the same up to a homeomorphism that moves nothing of the rim: whether the cells
//             beside them differ does not matter.)
//   u curve:  as uv is in X1, u is a node of P with arms to a1 .. ad, all of Lk(uv) n X2. In D', P'
//             is what the pattern of u is off v: its other node, with d arcs that end in a1 .. ad,
//             each with its label. They cross nowhere, so they lie round it in the order of their
//             ends on the rim, as the arms do. They touch P outside D in their ends only, by (2).
//             The other node may itself be one of the ai: it is no node of P then, by (1), and is
//             moved there along its arm; of a sheet that ends, d = 1, a triangle goes that had two
//             edges on its rim. So node for node, arm for arm, P' is P.
// Of (2) and (1) nothing was used but for the lower kind u, so v may be of any kind.
//
// Where neither u nor v is on the boundary, (3) follows from the cells' orientation, as link.h
// says.
class StrataCondition {
 public:
  struct End {
    uint32_t vertex;
    Stratum stratum;
    bool outside;
  };
  // Of the faces round each end at least those that are labelled with cells of one label on both
  // sides, as edges of the link, sorted.
  struct Labelled {
    std::vector<uint64_t> u, v;
  };
  // What (1) and the cells that hold both ends tell, before their stars are known: most edges
  // between two sheets fail here. `in_labelled`: uv is an edge of a labelled face.
  static bool mayHold(End u, End v, const Star& ring, const Embedded& embedded, bool in_labelled);
  // The faces of X2 round both ends. `flags` of all vertices of the stars: those of kOnSheet are
  // set at least for the faces of sheets round u and v.
  void list(End u, End v, const Stars& stars, const uint8_t* flags, const Embedded& embedded,
            const Labelled& labelled);
  // visit(x, a, b) for each of them, with the end x that it is round.
  template <class Visit>
  void forFaces(End u, End v, Visit visit) const {
    for (uint64_t face : faces_u_) visit(u.vertex, lowOf(face), highOf(face));
    for (uint64_t face : faces_v_) visit(v.vertex, lowOf(face), highOf(face));
  }
  // (2) and (1), of the ends whose faces were listed.
  bool holds(End u, End v, const Embedded& embedded);

 private:
  struct Edge {  // of a link, and a cell there
    uint64_t ends;
    uint32_t cell;
  };
  void listSheets(const Star& star, const Star& ring, const uint8_t* flags,
                  const CellLabels& labels, const std::vector<uint64_t>& labelled,
                  std::vector<uint64_t>& faces);
  bool linksAgree(uint32_t v);

  std::vector<Edge> edges_;
  std::vector<uint64_t> faces_u_, faces_v_;  // of X2, as edges of the link
  std::vector<uint32_t> shared_;             // the vertices of Lk(uv) in X2
};

}  // namespace tetstream
