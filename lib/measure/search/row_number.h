// measure/search: numbers that look random, made of places: the same whatever the order in which
// cells come. Depends on base.
#pragma once

#include <bit>

#include "mix.h"

namespace tetstream {

inline uint64_t numberOf(const double* places, int count, uint64_t seed) {
  uint64_t number = seed;
  for (int k = 0; k < count; ++k) number = mix(number + std::bit_cast<uint64_t>(places[k]) + 1);
  return number;
}

// From 0 to 1, without 1.
inline double shareOf(uint64_t random) {
  return static_cast<double>(random >> 11) * 0x1p-53;
}

}  // namespace tetstream
