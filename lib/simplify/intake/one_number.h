// simplify/intake: whether values are one number but for rounding. Depends on schema.h.
#pragma once

#include <algorithm>
#include <cmath>

#include "schema.h"

namespace tetstream {

// What differs by no more units in its last place is one number but for rounding, as are a density
// of 1000, a gravity of 9.81 or weights that add up to 1: as a field it would be noise of the size
// of the cells, which no mesh follows but the input. Five neighbouring float32; of float64, which
// have come through more sums, some hundreds: no measurement has as many digits.
constexpr double kRounding32 = 4, kRounding64 = 512;

inline double lastPlace(double value, ScalarType type) {
  const int digits = type == ScalarType::kFloat32 ? 23 : 52;
  return value == 0 ? 0 : std::ldexp(1.0, std::ilogb(value) - digits);
}

// Of a field each component is told by its own size; beside a larger one it may be what rounding
// leaves of that, as a turned gravity has it, and no more.
inline bool isOneNumber(double low, double high, double largest, ScalarType type) {
  const double units = type == ScalarType::kFloat32 ? kRounding32 : kRounding64;
  const double own = std::max(std::fabs(low), std::fabs(high));
  return high - low <= std::max(units * lastPlace(own, type), lastPlace(largest, type));
}

}  // namespace tetstream
