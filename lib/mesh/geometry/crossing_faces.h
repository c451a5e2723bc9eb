// mesh/geometry: whether two triangles pass through each other. Depends on vector3.h.
#pragma once

#include <cstdint>

namespace tetstream {

// Coordinates are relative to a place near by: heights over planes are differences of products.
struct PlacedFace {
  PlacedFace(uint32_t a, uint32_t b, uint32_t c) : corner{a, b, c} {}  // nothing else is set

  uint32_t corner[3];
  double at[3][3];
  double normal[3];        // twice the area long
  double offset;           // of its plane: the normal times a point on it
  double longest;          // edge
  double near;             // what lies nearer to the plane, times the normal's length, lies on it
  double low[3], high[3];  // its box

  bool has(uint32_t v) const { return corner[0] == v || corner[1] == v || corner[2] == v; }
  void setNormal();  // and the longest edge, from `at`
  void setPlane();   // and all else
};

// Whether an edge of one passes through the other. One that ends on the other's plane, as at a
// common corner, does not: as near to it as a ten-thousandth of the longest edge.
bool cross(const PlacedFace& a, const PlacedFace& b);

}  // namespace tetstream
