// simplify/state: the RMS error of the fields, measured at points. Depends on core.h.
//
// The quadrics tell an error that the fields' is below as a rule, often by half, and that of the
// boundary and of shapes with it. What the error is shows where it is measured: of the cells that
// are read some have a point by chance, whose values wait until the cell that it lies in then
// leaves the window. A cell is as likely to have one as its share of the volume and that of the
// number of cells are in the mean, so that neither large cells nor a finely meshed part is missed,
// and each point stands for as much volume as that makes. Where they have missed what makes errors,
// as small parts of a graded mesh, shows in what quadrics tell there: of that their points find
// less than the cells have. The rest counts as quadrics tell it (a difference estimator). What lies
// outside counts where a cell is nearest: of slender bodies, whose ends draw in, that may be most
// of the error.
#pragma once

#include <cstdint>

#include "core.h"

namespace tetstream {

template <class S>
class ErrorSample {
 public:
  // For a window of so many cells.
  ErrorSample(Core<S>& core, Account& account, size_t cells);

  // Cells [first, end) of the window are new, and their scales are known.
  void take(uint32_t first, uint32_t end);
  // Cells leave, between the two: all of them, or some.
  void startLeaving(bool all);
  void leave(uint32_t cell);
  void endLeaving();
  // Squared errors count so many times as much in the units of now.
  void rescale(double factor);

  // In percent of the range, with what chance may have left out: of what has left, and with the
  // live cells as they are. What quadrics tell where nothing was measured.
  double percent() const { return percentOf(sum_); }
  double percentNow();
  // Bounds what quadrics may tell by what is measured now, for the error that is allowed. Returns
  // whether much of that is left.
  bool limitError();
  bool limitErrorAfterPass();

 private:
  // Of points: their weights, squared errors by weight, and the squares of these; the same of what
  // quadrics tell there; and of that, of all cells.
  struct Sum {
    double weight = 0, error = 0, square = 0;
    double told = 0, told_square = 0, told_of_all = 0;
  };

  size_t roomFor(size_t cells) const;
  double percentOf(const Sum& sum) const;
  double missedShare(const Sum& sum) const;
  const S* point(size_t i) const { return points_.data() + i * dimension(); }
  size_t dimension() const { return static_cast<size_t>(core_.plan.dimension); }
  void placeByTurns(uint32_t cell, uint64_t number, double volume);
  void placeIn(uint32_t cell, uint64_t number, double weight);
  template <class Visit>
  void forLive(Visit visit) const;
  void addOutside(Sum& sum);
  void thinOut();
  void compact();
  void sort();
  void chooseBins();
  size_t binAlong(int axis, S x) const;
  size_t binOf(const S x[3]) const;
  void scaled(const S x[3], double out[3]) const;
  template <class Visit>
  void visit(uint32_t cell, Visit visitOne) const;
  double weightFound(size_t component) const;
  double squaredError(size_t i, uint32_t cell, const double weights[4]) const;
  void toldAt(uint32_t cell, double told[4]) const;
  template <class Seen>
  void addCell(Sum& sum, uint32_t cell, Seen seen) const;
  void addPoint(Sum& sum, size_t i, uint32_t cell, const double w[4], const double told[4]) const;

  Core<S>& core_;
  Array<S> points_;        // of each, in the user's units: the place, and the fields there
  Array<float> weights_;   // the volume that each stands for; 0: gone; below 0: found
  Array<uint32_t> begin_;  // of bins: where their points begin among those in order
  Array<uint32_t> order_;
  Array<S> places_;  // of points in order
  size_t room_, count_ = 0;
  uint64_t cells_ = 0;               // that were read
  uint64_t blocks_ = 0;              // of cells, one of which was looked at
  uint64_t looked_at_ = 0;           // cells that had a volume
  double volume_ = 0;                // of what was looked at
  double stride_ = 0, due_ = 0;      // shares between points, and since the last one
  double low_[3], bins_by_unit_[3];  // of bins
  size_t bins_[3];
  Sum sum_;                   // of what has left
  bool is_measured_ = false;  // all that is live and leaves now
  double made_ = 0;           // by what quadrics tell, when the limit was set
};

}  // namespace tetstream
