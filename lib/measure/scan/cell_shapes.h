// measure/scan: the shapes of the cells of a mesh. Depends on mesh/geometry.
#pragma once

#include <cstdint>

namespace tetstream {

struct ShapeFigures {
  double volume = 0;                              // of all cells, without signs
  int64_t positive = 0, negative = 0;             // cells by the sign of their volume, exactly
  int64_t flat = 0;                               // of no volume, exactly
  double least_angle = 0, largest_angle = 0;      // between two faces of a cell, degrees
  double mean_least_angle = 0;                    // of the cells' least ones
  double below_1 = 0, below_5 = 0, below_10 = 0;  // share of cells whose least one is
  // Circumradius over three inradii: 1 for a regular cell, infinite for a flat one. The median and
  // the 99th percentile within 1 %.
  double largest_aspect = 0, median_aspect = 0, p99_aspect = 0;
  int64_t inverted() const { return positive < negative ? positive : negative; }
};

class CellShapes {
 public:
  // `corners`: [4][3]; `side`: the exact sign of the volume.
  void add(const double* corners, int side);
  ShapeFigures figures() const;
  double lastVolume() const { return last_volume_; }

 private:
  // Aspects in steps of 1 % from 1 on; the last one takes all that are larger, to 1e9.
  static constexpr int kSteps = 2084;
  double percentile(double share) const;

  ShapeFigures sums_;
  int64_t cells_ = 0, below_[3] = {};
  int64_t aspects_[kSteps] = {};
  double last_volume_ = 0;
};

}  // namespace tetstream
