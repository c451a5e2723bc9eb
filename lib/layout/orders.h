// layout: the orders that a mesh may be brought into, by name. Depends on nothing.
#pragma once

#include <string>

namespace tetstream {

// An order ranks the vertices; a cell then comes with its last vertex (Vo et al. 2007,
// section 3.2).
enum class Order {
  kAuto,          // the one that the mesh asks for
  kNone,          // cells as they are in the file
  kSpatial,       // along a direction
  kBrick,         // cube by cube
  kZOrder,        // along Lebesgue's curve
  kHilbert,       // along Hilbert's curve
  kBreadthFirst,  // by the distance from a vertex of the boundary
  kSpectral,      // by the Fiedler vector
};

// Throws kBadArgument with what there is.
Order orderOf(const std::string& name);
const char* nameOf(Order order);

}  // namespace tetstream
