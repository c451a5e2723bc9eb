// layout: keys by which vertices are sorted, from their places. Depends on base.
#pragma once

#include <cstdint>

namespace tetstream {

// Keys order as the numbers do; no NaN.
uint64_t keyOfNumber(double number);

// Places are given in cells of a grid with 2^kGridBits to an axis.
constexpr int kGridBits = 21;
uint64_t mortonKey(const uint32_t cell[3]);
// The distance along Hilbert's curve (Skilling, Programming the Hilbert curve, 2004).
uint64_t hilbertKey(const uint32_t cell[3]);

// A box in cubes: as a grid of 2^kGridBits to its longest side, or as bricks that hold some number
// of vertices if they are spread evenly, one after the other, the longest side last.
class BoxGrid {
 public:
  BoxGrid(const double low[3], const double high[3]);
  void cellOf(const double place[3], uint32_t cell[3]) const;
  void setBricks(double vertices, double vertices_per_brick);
  uint64_t brickKey(const double place[3]) const;

 private:
  double low_[3], size_[3], unit_, brick_ = 1;
  int axis_[3];                     // from the shortest side to the longest
  uint64_t bricks_[3] = {1, 1, 1};  // along axis_
};

}  // namespace tetstream
