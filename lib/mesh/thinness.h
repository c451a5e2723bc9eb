// mesh: how thin a cell is, as a number to compare. Depends on orient.h.
#pragma once

namespace tetstream {

// The square of the cosine of the cell's smallest dihedral angle: 1/9 for the regular cell, 1 for a
// flat one; larger is worse. kTurned where its volume is not strictly positive, which is decided
// exactly.
constexpr double kTurned = 2;
double thinness(const double p[4][3]);
// Of a cell with this smallest angle, from 0 to 90.
double thinnessOfAngle(double degrees);
// The shape of star_kernels.h, which bounds the smallest angle from below at less cost: 1 for the
// regular cell, 0 for a flat one. Corners are multiplied by `scale`; of a cell that is much smaller
// or larger than 1 then it may be no number.
double regularity(const double p[4][3], double scale);

}  // namespace tetstream
