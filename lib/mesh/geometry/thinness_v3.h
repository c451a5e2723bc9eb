// mesh/geometry: the thinness of several cells, built for x86-64-v3 processors. Internal to the
// room.
#pragma once

#include "thinness.h"

namespace tetstream::v3 {

void thinnessOfFour(const float* values, int stride, const uint32_t (*corners)[4], double* out);
void thinnessOfFour(const double* values, int stride, const uint32_t (*corners)[4], double* out);

}  // namespace tetstream::v3
