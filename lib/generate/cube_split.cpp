#include "cube_split.h"

#include <utility>

namespace tetstream {

namespace {

// Axes in the order in which a path takes them. note: cells that touch the end of the diagonal
// alone with the cube's far face along z come first, those that share most of that face last; with
// this order the front of the sweep is smallest.
constexpr int kPaths[kCubeCells][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1},
                                       {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};

// A path is positive if it is an even permutation that mirrors an even number of axes, or odd in
// both.
bool isPositive(const int path[3], int start) {
  int inversions = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 3; ++j) inversions += path[i] > path[j];
  const int mirrored = (start & 1) + (start >> 1 & 1) + (start >> 2 & 1);
  return (inversions + mirrored) % 2 == 0;
}

// A corner's later cubes lie where its bit is set, unless the cube is the last along that axis.
bool endsHere(int corner, int last_axes) {
  return (corner & ~last_axes) == 0;
}

}  // namespace

CubeSplit splitCube(int start) {
  CubeSplit split = {};
  int last_cell[8] = {}, last_corner[8] = {};
  for (int c = 0; c < kCubeCells; ++c) {
    int corners[4] = {start, 0, 0, 0};
    for (int j = 1; j < 4; ++j) corners[j] = corners[j - 1] ^ (1 << kPaths[c][j - 1]);
    if (!isPositive(kPaths[c], start)) std::swap(corners[2], corners[3]);
    for (int j = 0; j < 4; ++j) {
      split.corners[c][j] = static_cast<uint8_t>(corners[j]);
      last_cell[corners[j]] = c;
      last_corner[corners[j]] = j;
    }
  }
  for (int axes = 0; axes < 8; ++axes)
    for (int corner = 0; corner < 8; ++corner)
      if (endsHere(corner, axes))
        split.last_uses[axes][last_cell[corner]] |= static_cast<uint8_t>(1 << last_corner[corner]);
  return split;
}

}  // namespace tetstream
