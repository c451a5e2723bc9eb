// mesh/geometry: the side of a plane on which a point lies, exactly. Depends on nothing.
#pragma once

namespace tetstream {

// Sign of det(b - a, c - a, d - a), six times the signed volume of the cell (a, b, c, d), decided
// exactly for finite doubles (along each axis: not more than 2^300 apart in size, or equal, or
// zero): floating-point filter first, expansions where it cannot tell (Shewchuk, Adaptive precision
// floating-point arithmetic, 1997).
int orientation(const double a[3], const double b[3], const double c[3], const double d[3]);

// Of the coordinates of b, c and d from those of a; not zero.
double largestDifference(const double a[3], const double b[3], const double c[3],
                         const double d[3]);

// det = a . (b x c) of coordinate differences, in doubles: its rounding error is at most
// (7 + 56 u) u times the sum of the absolute products, u = 2^-53, the rounding of the differences
// included (Shewchuk 1997, section 4.3). Raised a little for the rounding of the bound itself.
constexpr double kOrientationBound = 8.0 / 9007199254740992.0;

}  // namespace tetstream
