// layout: an indexed mesh as the orders see it. Depends on base.
#pragma once

#include <cstdint>

#include "memory.h"

namespace tetstream {

// A mesh's connectivity and the places of its vertices, each along three axes in [0, 1].
struct Connectivity {
  explicit Connectivity(Account& account) : corners(account), places(account) {}
  uint32_t vertices = 0, cells = 0;
  Array<uint32_t> corners;  // [cells][4]
  Array<float> places;      // [3][vertices]
  const uint32_t* cell(uint32_t number) const { return corners.data() + 4 * size_t{number}; }
};

}  // namespace tetstream
