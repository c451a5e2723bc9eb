// mesh/geometry: how thin a cell is, as a number to compare. Depends on orient.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include "orient.h"

namespace tetstream {

// The square of the cosine of the cell's smallest dihedral angle: 1/9 for the regular cell, 1 for a
// flat one; larger is worse. kTurned where its volume is not strictly positive, which is decided
// exactly.
constexpr double kTurned = 2;
double thinness(const double p[4][3]);
// The same of so many cells at a time. Coordinates of vertex v: the first three numbers at
// values + v * stride; four must be readable.
constexpr size_t kThinLanes = 4;
template <class S>
void thinnessOfFour(const S* values, int stride, const uint32_t (*corners)[4], double* out);
// Of a cell with this smallest angle, from 0 to 90.
double thinnessOfAngle(double degrees);
// The shape of star_kernels.h, which bounds the smallest angle from below at less cost: 1 for the
// regular cell, 0 for a flat one. Corners are multiplied by `scale`; of a cell that is much smaller
// or larger than 1 then it may be no number.
double regularity(const double p[4][3], double scale);

// 6 V = e0 . (e1 x e2), of the edges from the first corner, is wrong by no more than
// kOrientationBound times the sum of its products' sizes, which is at most the sum of their squares
// to the power of 3/2: squared, one above kSureVolume times its cube has its sign. Within the
// limits of the sum nothing over- or underflows; beyond them cells are brought to size.
constexpr double kSureVolume = 4 * kOrientationBound * kOrientationBound;
constexpr double kLeastThinSum = 1e-40, kLargestThinSum = 1e70;

}  // namespace tetstream
