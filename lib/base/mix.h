// base: a number in, one that looks random out. Depends on nothing.
#pragma once

#include <cstdint>

namespace tetstream {

// One to one; 0 stays 0.
inline uint64_t mix(uint64_t x) {
  x = (x ^ (x >> 31)) * 0x7fb5d329728ea185ull;
  x = (x ^ (x >> 27)) * 0x81dadef4bc2dd44dull;
  return x ^ (x >> 33);
}

// At least 0 and below 1, each as likely, of what looks random.
inline double uniform(uint64_t random) {
  return static_cast<double>(random >> 11) * 0x1p-53;
}

}  // namespace tetstream
