// layout/graph: an indexed mesh as the orders see it. Depends on base.
#pragma once

#include <cstdint>

#include "memory.h"

namespace tetstream {

struct Connectivity {
  explicit Connectivity(Account& account) : corners(account) {}
  uint32_t vertices = 0, cells = 0;
  Array<uint32_t> corners;  // [cells][4]
  const uint32_t* cell(uint32_t number) const { return corners.data() + 4 * size_t{number}; }
};

}  // namespace tetstream
