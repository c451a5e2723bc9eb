// simplify/collapse: whether a collapse would push the boundary through itself, or fold it; and the
// faces of the boundary round an edge. Depends on mesh, axis_planes.h.
#pragma once

#include <vector>

#include "axis_planes.h"
#include "crossing_faces.h"
#include "link_edges.h"
#include "patch.h"

namespace tetstream {

// Cells that all have their right orientation overlap only where the boundary of their union
// crosses itself. Only a place in front of a face on the boundary that goes can make it do so; one
// that is by more than a little has the new faces held against each other and against those round
// the vertices of their rim: of a patch against those that it has a cell of, and where it does not
// have all, not if the place is far in front. Parts of the boundary that are farther apart along it
// are not compared, nor are those round a vertex of many cells.
//
// Nor may it be laid on itself: two faces that share an edge would leave a crack of no width, or a
// blade, that neither volumes nor quadrics of coplanar faces tell of.
template <class Mesh>
class BoundaryCrossing {
 public:
  using S = typename Mesh::Scalar;

  BoundaryCrossing(Mesh& mesh, Account& account)
      : mesh_(mesh), star_(account, 32), link_(account) {}

  // An edge with its stars, whole: what follows is about the faces round its ends.
  void list(uint32_t u, uint32_t v, const Stars& stars);
  // Adds those, unless there are too many to know all.
  void addTo(AxisPlanes<S>& planes) const;
  // Whether more pairs of faces would cross than do, or lie on each other, with the ends merged at
  // `place`. `scale` brings edges near 1.
  bool find(const S* place, double scale);

 private:
  using Faces = std::vector<PlacedFace>;

  bool listFaces(uint32_t centre, const Star& star, const Star* more, Faces& faces);
  void put(Faces& faces) const;
  double putGone();
  bool listMade();
  void listRim();
  bool knowsBeside() const;
  void listBeside();
  size_t crossings(const Faces& faces) const;
  size_t folds(const Faces& faces) const;

  Mesh& mesh_;
  uint32_t u_ = 0, v_ = 0;
  bool is_large_ = false, is_whole_ = false;
  Star star_;
  double origin_[3] = {}, scale_ = 1;  // of the coordinates of faces: the merged vertex's place
  LinkEdges link_;
  Faces gone_, made_, beside_;
  std::vector<uint32_t> rim_, seen_;
};

}  // namespace tetstream
