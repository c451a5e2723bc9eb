// mesh/geometry: a point as the weighted mean of a cell's corners. Depends on nothing.
#pragma once

namespace tetstream {

// The weights w of the corners p, sum w = 1 and sum w p = x, whatever the cell's shape or
// orientation: the residual is that of rounding the terms of the sum, so that a linear field is
// reproduced; of a thin cell it is the weights that may be inexact. A point upon a corner gets 1
// there and 0 elsewhere. Below 0 no weight is nearer to it than kLeastOutside: a point that
// rounding alone put outside is inside. Along a direction in which the cell has no extent x is
// projected; where weights would be above kLargestWeight, of no use to anybody, also along those in
// which it has less than that part of its largest extent.
void barycentricWeights(const double p[4][3], const double x[3], double w[4]);

constexpr double kLeastOutside = 1e-13, kLargestWeight = 1e8;

// Faster and less exact: those of x, or of a point of the cell where x lies outside; of a flat cell
// they stay as they are.
void clampedWeights(const double p[4][3], const double x[3], double w[4]);

// The same for many points, faster and less exact: w_k = row_k . (x - o), k = 1 to 3, the rows
// those of the inverse of the edges from o, corner 0.
struct CellFrame {
  double o[3], row[3][3];

  // `corners`: [4][3]. Returns 6 V; where that is 0 no row is a number.
  double set(const double* corners);
  void weights(const double x[3], double w[4]) const {
    const double d[3] = {x[0] - o[0], x[1] - o[1], x[2] - o[2]};
    for (int k = 0; k < 3; ++k) w[k + 1] = row[k][0] * d[0] + row[k][1] * d[1] + row[k][2] * d[2];
    w[0] = 1 - w[1] - w[2] - w[3];
  }
};

}  // namespace tetstream
