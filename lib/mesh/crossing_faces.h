// mesh: whether two triangles pass through each other. Depends on nothing.
#pragma once

#include <cstdint>

namespace tetstream {

struct PlacedFace {
  uint32_t corner[3];
  double at[3][3];
  double low[3], high[3];  // what it lies in

  bool has(uint32_t v) const { return corner[0] == v || corner[1] == v || corner[2] == v; }
  void bound();  // from `at`
};

// Whether an edge of one passes through the other, as far as doubles tell. One that ends at a
// corner of the other does not.
bool cross(const PlacedFace& a, const PlacedFace& b);

}  // namespace tetstream
