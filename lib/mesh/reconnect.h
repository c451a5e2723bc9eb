// mesh: other cells in the place of some: flips. Depends on patch.h, thinness.h.
//
// After Freitag and Ollivier-Gooch 1997 and Klingner and Shewchuk 2007. A flip replaces cells by
// others with the same outer faces, so boundary, interfaces and vertices stay; with the new cells
// strictly positive, which is decided exactly, they cover the same points once. Where the mesh
// folds over itself, as after rounding, or where two sides of it have vertices in common but not
// what lies between them, as beside hanging nodes, an edge or a face that a flip makes may be there
// already, elsewhere: such a flip is none.
#pragma once

#include "patch.h"
#include "thinness.h"

namespace tetstream {

struct Reconnection {
  static constexpr uint32_t kMostRing = 7, kMostCells = 2 * (kMostRing - 2);
  uint32_t gone[kMostRing], made[kMostCells][4];  // cells; corners, positively ordered
  uint32_t gone_count = 0, made_count = 0;
  // The worst thinness; kTurned, with `made` not complete, where it would not gain what is asked
  // for.
  double before = -1, after = kTurned;
  bool improves() const { return after < before; }
};

// Finds flips in a patch, and does them.
template <class S>
class Reconnector {
 public:
  Reconnector(Patch<S>& patch, Account& account)
      : patch_(patch), star_(account), ring_(account), thinness_(account) {}

  // Another patch, or one that was changed otherwise. `may_repeat`: there are such places in the
  // mesh; then of no use are flips that make an edge or a face between vertices of which none is
  // free, whose cells are not all known.
  void start(bool may_repeat);
  // As Patch::replace.
  void replace(const Reconnection& r, uint32_t* slots);

  // Measures the live cells that are wanted, several at a time: those that will be asked for.
  template <class Wanted>
  void measure(Wanted wanted) {
    uint32_t cells[kThinLanes];
    size_t count = 0;
    for (uint32_t c = 0; c < patch_.cellEnd(); ++c) {
      if (!patch_.isLive(c) || !wanted(c)) continue;
      cells[count++] = c;
      if (count == kThinLanes) measureFour(cells);
      count %= kThinLanes;
    }
  }

  // The face opposite corner j of cell c makes way for an edge: two cells become three. False where
  // it is on the boundary or the cell beyond is not known. Of no interest are flips after which the
  // worst thinness is not less by more than `least_gain`: they are not looked at any further.
  bool removeFace(uint32_t c, uint32_t j, Reconnection& out, double least_gain = 0);
  // The edge between corners i and j of cell c makes way for triangles spanning its ring: n cells
  // become 2 (n - 2), by the best triangulation. False where it is on the boundary, its ring is not
  // known or has more than `most_ring` cells.
  bool removeEdge(uint32_t c, uint32_t i, uint32_t j, Reconnection& out,
                  uint32_t most_ring = Reconnection::kMostRing, double least_gain = 0);
  double thinnessOfCell(uint32_t c);

 private:
  void thinnessAt(const uint32_t (*corners)[4], double* out) const {
    thinnessOfFour(patch_.allValues(), patch_.valueStride(), corners, out);
  }
  void measureFour(const uint32_t* cells);
  bool mayBeThere(const uint32_t* vertices, size_t count) const;
  bool hasEdge(uint32_t a, uint32_t b);
  bool hasFace(const uint32_t corners[3]);
  bool orderRing(uint32_t v, uint32_t* ring) const;
  void addGone(uint32_t c, Reconnection& out);
  struct Chains;
  void addTriangles(uint32_t u, uint32_t v, const uint32_t* ring, uint32_t length, double limit,
                    Chains& chains) const;
  void triangulate(uint32_t u, uint32_t v, const uint32_t* ring, double least_gain,
                   Reconnection& out);

  Patch<S>& patch_;
  Star star_, ring_;
  bool may_repeat_ = false;
  Array<double> thinness_;  // per cell of the patch, below -1 where not known
};

}  // namespace tetstream
