// simplify/collapse: where two vertices go that become one, and the values that they have there.
// Depends on core.h, mesh, axis_planes.h, region_volumes.h, curve_area.h.
#pragma once

#include <algorithm>
#include <vector>

#include "axis_planes.h"
#include "core.h"
#include "patch.h"
#include "region_volumes.h"

namespace tetstream {

template <class Mesh>
class MergedPlace {
 public:
  using S = typename Mesh::Scalar;

  MergedPlace(Core<S>& core, Mesh& mesh)
      : core_(core),
        mesh_(mesh),
        values_(static_cast<size_t>(core.plan.values)),
        z_(static_cast<size_t>(core.plan.dimension)) {}

  // Of u and v at z, normalised and relative to their edge's midpoint, with what u carries. Returns
  // whether the values gave way to what their field may have.
  bool set(uint32_t u, uint32_t v, const S* z);
  S error() const;  // there
  bool isFinite() const;
  const std::vector<S>& values() const { return values_; }
  bool isFartherFromU() const;  // than from v

  // With features, curves stay where they are: what is merged with a vertex of one goes there, and
  // between two of them a place off their edge by rounding goes onto it. False, and nothing is
  // done, for other places between two.
  bool putOnCurve(bool u_on_it, bool v_on_it);
  // Of two vertices of a curve, with those behind them: to where the area is kept that the curve
  // bounds; false if it stays.
  bool keepCurveArea(uint32_t behind_u, uint32_t behind_v);
  // Whether a region of the stars is larger there than before, or smaller, or the body.
  bool changesVolumes(const Stars& stars, const CellLabels& labels);
  // Of those measured last: whether a region would lose or win a share of its volume that counts,
  // or a side, or the body, of the body's.
  bool givesUpRegion(const CellLabels& labels, const double step[3]) const;
  // The same for what it would have lost or won in all, with what tallies tell.
  bool driftsOff(const CellLabels& labels, const Tally& whole, const Tally& part) const;
  void addDrifts(const CellLabels& labels, Tally& tally) const;
  // By as much as it takes, to where no region of the stars grows or shrinks, or side of a sheet,
  // or the body; returns the error there. Where that is too far: infinity, but for sides.
  S keepVolumes(const Stars& stars, const CellLabels& labels, const SheetSides* sides);

  // How far the coordinates of what lies in one plane may be apart.
  S roundingOfPlanes() const;
  // Onto the planes round the two vertices, where these are near: to a coordinate that is one
  // there, which it then keeps, unless volumes cannot be. Returns whether it moved.
  bool putOnPlanes(const AxisPlanes<S>& planes);

  // Carried fields take the value that the old cells have there.
  void interpolateCarried(const Stars& stars);

 private:
  bool update();
  double squaredLength() const;  // of the edge, normalised
  void leavePlanes() { std::fill_n(stays_, 3, false); }
  bool staysAnywhere() const { return stays_[0] || stays_[1] || stays_[2]; }
  void moveBy(const S step[3]);
  struct Region {
    const void* key;  // in a tally
    double volume;
  };
  Region regionOf(const CellLabels& labels, const int64_t* row) const;
  void measureVolumes(const Stars& stars, const CellLabels& labels, const SheetSides* sides);

  double at(size_t axis) const { return static_cast<double>(values_[axis]); }

  Core<S>& core_;
  Mesh& mesh_;
  uint32_t u_ = 0, v_ = 0;
  RegionVolumes volumes_;
  std::vector<S> values_;
  std::vector<S> z_;  // the place, normalised and relative to the edge's midpoint
  bool stays_[3] = {false, false, false};  // along each axis in a plane,
  S plane_[3] = {0, 0, 0};                 // there
};

}  // namespace tetstream
