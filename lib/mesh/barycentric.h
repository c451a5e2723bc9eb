// mesh: a point as the weighted mean of a cell's corners. Depends on nothing.
#pragma once

namespace tetstream {

// The weights w of the corners p, sum w = 1 and sum w p = x, whatever the cell's shape or
// orientation: the residual is that of rounding the terms of the sum, so that a linear field is
// reproduced; of a thin cell it is the weights that may be inexact. A point upon a corner gets 1
// there and 0 elsewhere. Below 0 no weight is nearer to it than kLeastOutside: a point that
// rounding alone put outside is inside. Along a direction in which the cell has no extent x is
// projected.
void barycentricWeights(const double p[4][3], const double x[3], double w[4]);

constexpr double kLeastOutside = 1e-13;

}  // namespace tetstream
