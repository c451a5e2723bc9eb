// mesh/geometry: one triangle: its area, and its point nearest to another one: arithmetic only.
// Depends on nothing.
#pragma once

namespace tetstream {

double triangleArea(const double* corners);  // [3][3]

// The squared distance to the nearest point, whose barycentric coordinates are told.
double squaredDistance(const double* corners, const double place[3], double coordinates[3]);

}  // namespace tetstream
