// mesh/geometry: two vertices as one number, the lower one in the high half, so that pairs sort and
// compare as numbers do. Depends on nothing.
#pragma once

#include <cstdint>
#include <vector>

namespace tetstream {

inline uint64_t pairOf(uint32_t a, uint32_t b) {
  return a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a;
}

inline uint32_t lowOf(uint64_t pair) {
  return static_cast<uint32_t>(pair >> 32);
}
inline uint32_t highOf(uint64_t pair) {
  return static_cast<uint32_t>(pair);
}

inline bool holdsVertex(const std::vector<uint64_t>& pairs, uint32_t v) {
  for (uint64_t pair : pairs)
    if (lowOf(pair) == v || highOf(pair) == v) return true;
  return false;
}

}  // namespace tetstream
