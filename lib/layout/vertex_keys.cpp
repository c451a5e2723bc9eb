#include "vertex_keys.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tetstream {

uint64_t keyOfNumber(double number) {
  const auto bits = std::bit_cast<uint64_t>(number + 0.0);  // -0 is 0
  constexpr uint64_t kSign = uint64_t{1} << 63;
  return bits & kSign ? ~bits : bits | kSign;
}

// Two zero bits after each of the lowest 21.
static uint64_t spread(uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffffull;
  x = (x | x << 16) & 0x001f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

uint64_t mortonKey(const uint32_t cell[3]) {
  return spread(cell[0]) << 2 | spread(cell[1]) << 1 | spread(cell[2]);
}

// From the top bit down each cube is turned and mirrored as its place in the next larger one asks;
// what is left is Gray code.
uint64_t hilbertKey(const uint32_t cell[3]) {
  uint32_t x[3] = {cell[0], cell[1], cell[2]};
  for (uint32_t top = 1u << (kGridBits - 1); top > 1; top >>= 1) {
    const uint32_t below = top - 1;
    for (uint32_t& axis : x) {
      if (axis & top) {
        x[0] ^= below;
      } else {
        const uint32_t swapped = (x[0] ^ axis) & below;
        x[0] ^= swapped;
        axis ^= swapped;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  uint32_t flips = 0;
  for (uint32_t top = 1u << (kGridBits - 1); top > 1; top >>= 1)
    if (x[2] & top) flips ^= top - 1;
  for (uint32_t& axis : x) axis ^= flips;
  return mortonKey(x);
}

// At least 0, also what is no number.
static double within(double at, double last) {
  return at > 0 ? std::min(at, last) : 0;
}

BoxGrid::BoxGrid(const double low[3], const double high[3]) {
  for (int i = 0; i < 3; ++i) {
    low_[i] = low[i];
    const double size = high[i] - low[i];
    size_[i] = std::isfinite(size) && size > 0 ? size : 0;
    axis_[i] = i;
  }
  std::stable_sort(axis_, axis_ + 3, [this](int a, int b) { return size_[a] < size_[b]; });
  unit_ = size_[axis_[2]] > 0 ? 1 / size_[axis_[2]] : 0;
  if (!std::isfinite(unit_)) unit_ = 0;
}

void BoxGrid::cellOf(const double place[3], uint32_t cell[3]) const {
  constexpr double kCells = 1 << kGridBits;
  for (int i = 0; i < 3; ++i) {
    const double at = (place[i] - low_[i]) * unit_ * kCells;
    cell[i] = static_cast<uint32_t>(within(at, kCells - 1));
  }
}

// Sides of no length have one brick.
void BoxGrid::setBricks(double vertices, double vertices_per_brick) {
  double volume = 1;
  int sides = 0;
  for (double size : size_)
    if (size * unit_ > 1e-6) {
      volume *= size * unit_;
      ++sides;
    }
  const double share = std::min(vertices_per_brick / std::max(vertices, 1.0), 1.0);
  brick_ = sides > 0 ? std::pow(volume * share, 1.0 / sides) : 1;
  for (int k = 0; k < 3; ++k) {
    const double count = std::ceil(size_[axis_[k]] * unit_ / brick_);
    bricks_[k] = static_cast<uint64_t>(std::clamp(count, 1.0, 1e6));
  }
}

uint64_t BoxGrid::brickKey(const double place[3]) const {
  uint64_t key = 0;
  for (int k = 2; k >= 0; --k) {
    const double at = (place[axis_[k]] - low_[axis_[k]]) * unit_ / brick_;
    const auto last = static_cast<double>(bricks_[k] - 1);
    key = key * bricks_[k] + static_cast<uint64_t>(within(std::floor(at), last));
  }
  return key;
}

}  // namespace tetstream
