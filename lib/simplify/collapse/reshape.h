// simplify/collapse: better shapes for the cells of a patch, by flips. Depends on core.h,
// collapse.h, mesh.
#pragma once

#include <limits>

#include "collapse.h"
#include "flip_observer.h"
#include "reconnect.h"

namespace tetstream {

// A flip lets collapses become legal that a thin cell stood against. It keeps vertices, boundary,
// interfaces and the cells' regions, and is taken where it makes the worst of the cells concerned
// less thin and changes the fields between the vertices by little. Of one patch at a time it is the
// same whatever was done to others.
template <class S>
class Reshaper {
 public:
  // What it does it counts in the tally.
  Reshaper(Core<S>& core, Patch<S>& patch, Tally& tally, Account& account);

  void observe(FlipObserver* observer) { observer_ = observer; }

  // Flips at each cell with a dihedral angle not much above the floor, while the window's cells
  // stay between the limits, for a change of the fields that is not large beside the error of the
  // whole. Returns whether there was one. Cells are passed over that had no flip before, with all
  // as it was: hasMoved(v) says of an owned vertex whether it has moved since.
  template <class HasMoved>
  bool reshape(int64_t least_cells, int64_t most_cells, double error, HasMoved hasMoved) {
    start(hasMoved);
    most_change_ = meanOf(error);
    return flipAll(least_cells, most_cells);
  }
  // The same at each thin cell, where the field comes first: flips that leave fewer of them and no
  // more cells in all, for a change of the fields that is little beside an error of `bound`.
  template <class HasMoved>
  bool thinOut(int64_t least_cells, double bound, HasMoved hasMoved) {
    start(hasMoved);
    most_change_ = kBoundShare * bound;
    counts_thin_ = true;
    return flipAll(least_cells, std::numeric_limits<int64_t>::max());
  }
  // After the patch was stored: the next sweep looks again at the edges of the vertices whose cells
  // were replaced.
  void unsettleChanged();

 private:
  // At 0.02 of the bound the whole error is hardly larger, since cells are saved; at 0.1 it is
  // much.
  static constexpr double kBoundShare = 0.02;

  // Of a vertex; the other marks are those of the vertices of its cells, too.
  enum Mark : uint8_t {
    kMoved = 1,
    kElsewhere = 2,  // free, but not owned here: flips there are looked for when seams lie
                     // elsewhere
    kNearMoved = 4,
    kNearSeam = 8,
    kFlipped = 16,  // cells of it were replaced
  };

  // Of the squared fields, measured and normalised.
  struct Change {
    double integral, mean;
  };

  template <class HasMoved>
  void start(HasMoved hasMoved) {
    start();
    for (uint32_t v = 0; v < patch_.ownedEnd(); ++v) marks_[v] = hasMoved(v) ? kMoved : 0;
  }
  void start();
  double meanOf(double error) const;
  bool flipAll(int64_t least_cells, int64_t most_cells);
  void markNear();
  bool isAsBefore(uint32_t c) const;
  uint8_t marksOf(uint32_t c) const;
  void rememberShaped();
  bool flipAt(uint32_t c);
  bool isLockedByCaller(uint32_t c, uint32_t j) const;
  bool hasLabelledFace(uint32_t slot) const;
  double worthOf(const Reconnection& r);
  int thinFewer(const Reconnection& r);
  bool isLegal(const Reconnection& r) const;
  Change change(const Reconnection& r) const;
  void positionsOf(const uint32_t corners[4], double p[4][3]) const;
  double normalisedSixVolume(double p[4][3]) const;
  void apply(const Reconnection& r);
  void handOverCellData(const Reconnection& r, const uint32_t* slots);
  double takeMeans(const Reconnection& r);
  const double* oldMeansAt(double place, uint32_t count) const;
  void tell(const Reconnection& r, const uint32_t* slots);

  Core<S>& core_;
  Patch<S>& patch_;
  Tally& tally_;
  Reconnector<S> reconnector_;
  Array<uint8_t> marks_;                   // per vertex of the patch
  std::vector<double> means_, old_means_;  // of float cell data; rows of the cells that are gone
  int64_t least_cells_ = 0, most_cells_ = 0;
  double most_change_ = 0;  // of the fields: the mean, or where thin cells count the integral
  bool counts_thin_ = false;
  FlipObserver* observer_ = nullptr;
};

}  // namespace tetstream
