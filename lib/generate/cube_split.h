// generate: a cube cut into six cells along a diagonal. Depends on nothing.
//
// Kuhn's split: each cell is the path from one end of the diagonal to the other that turns along
// the three axes in one of six orders. A cube's corner is a number of three bits, x y z from the
// lowest: the coordinates of the corner in the cube.
#pragma once

#include <cstdint>

namespace tetstream {

constexpr int kCubeCells = 6;

struct CubeSplit {
  uint8_t corners[kCubeCells][4];  // of each cell, positively oriented
  // last_uses[m][c], bit j: in a cube that is the last one along the axes of mask m, corner j of
  // cell c is used by no later cell, if cubes come with x running fastest, then y, then z.
  uint8_t last_uses[8][kCubeCells];
};

// The split along the diagonal from `start` to the opposite corner.
CubeSplit splitCube(int start);

}  // namespace tetstream
