// mesh/geometry: which corners of a cell its faces have. Depends on nothing.
#pragma once

#include <cstdint>

namespace tetstream {

// The face opposite corner j, so that (j, t0, t1, t2) is an even permutation of 0 1 2 3: it looks
// outward where the cell's volume is positive.
constexpr uint8_t kOpposite[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

}  // namespace tetstream
