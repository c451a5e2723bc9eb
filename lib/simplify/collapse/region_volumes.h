// simplify/collapse: places that keep the volumes of regions, of the sides of sheets, or of the
// body. Depends on mesh.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "sheet_sides.h"
#include "vector3.h"

namespace tetstream {

// Quadrics let closed surfaces shrink. The volume of each region round a merged vertex is a linear
// function of its position x: of a cell (x, t0, t1, t2) the gradient is -(t1 - t0) x (t2 - t0) / 6,
// and where cells of one region meet these cancel, so that what is left is normal to the sheets.
// The step that keeps all of them, or comes close to where there are more than three, and costs the
// quadrics least is added to the place that they want (after Lindstrom and Turk 1998, for
// surfaces): along the edge of a cube, and not off its faces.
class RegionVolumes {
 public:
  // Of one region, or side: its volume's change, if the vertex were at the origin, and the gradient
  // of that.
  struct Change {
    const int64_t* row;          // of labels, where these tell regions apart
    double volume, gradient[3];  // times 6
    double faces[2][3];          // sums of (t1 - t0) x (t2 - t0) over the cells of each end
  };

  // The cells round u and v, with coordinates relative to x, of which three numbers of `stride` to
  // a vertex are in `values`; lists the regions, or the sides where they are known.
  template <class S>
  void measure(const Stars& stars, const uint32_t ends[2], const S* values, size_t stride,
               const double x[3], const CellLabels& labels, const SheetSides* sides);
  // Whether any would be another at x, by more than is worth a word.
  bool anyChanges() const;
  // Whether any changes, of regions or sides, a step from x by more than is worth a word, is
  // refused: may(row of labels, change of the volume).
  template <class May>
  bool anyMayNot(const double step[3], May may) const {
    const double least = leastChange();
    return std::any_of(changes_.begin(), changes_.end(), [&](const Change& change) {
      const double there = change.volume + dot(change.gradient, step);
      return std::fabs(there) > least && !may(change.row, there / 6);
    });
  }
  // visit(row of labels, change of the volume at x)
  template <class Visit>
  void forChanges(Visit visit) const {
    for (const Change& change : changes_) visit(change.row, change.volume / 6);
  }
  // From x to where the volumes are as they were, along the axes that it may go; `form` tells what
  // a step costs, as its lower triangle by rows. False if that is farther than the edge is long: a
  // region that has but small faces at the vertex, such as one cell, would become a spike. Its
  // error is no help against it, as small faces weigh little.
  bool step(const double form[6], const bool stays[3], double out[3]) const;
  // Whether they are, a step from x, but for what is not worth leaving a plane for.
  bool areKeptInPlanes(const double step[3]) const;

 private:
  template <class S, class ChangeOf>
  void addCells(const Stars& stars, const S* values, size_t stride, const double x[3],
                const double tip[3], ChangeOf changeOf);
  double leastChange() const;
  size_t of(const int64_t* row, const CellLabels& labels, size_t likely);
  size_t ofPart(size_t part);
  void close(const double ends[2][3]);

  std::vector<Change> changes_;
  double edge_[3] = {0, 0, 0};  // from one end to the other
};

}  // namespace tetstream
