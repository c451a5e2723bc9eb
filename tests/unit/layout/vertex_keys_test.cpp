// Keys by which vertices are sorted: numbers in their order, curves that fill space.
#include "vertex_keys.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <vector>

namespace tetstream::test {
namespace {

TEST(VertexKeys, OrderAsNumbersDo) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double numbers[] = {-infinity, -1e300, -1, -1e-310, 0, 1e-310, 0.5, 1, 1e300, infinity};
  for (double a : numbers)
    for (double b : numbers) EXPECT_EQ(keyOfNumber(a) < keyOfNumber(b), a < b) << a << " " << b;
  EXPECT_EQ(keyOfNumber(-0.0), keyOfNumber(0.0));
}

struct Cell {
  uint32_t at[3];
  uint64_t key;
};

// The cells of a cube of the grid, `side` to an edge, by their keys.
std::vector<Cell> cubeAlong(uint64_t (*key)(const uint32_t[3]), uint32_t corner, uint32_t side) {
  std::vector<Cell> cells;
  for (uint32_t x = 0; x < side; ++x)
    for (uint32_t y = 0; y < side; ++y)
      for (uint32_t z = 0; z < side; ++z) {
        Cell cell = {{corner + x, corner + y, corner + z}, 0};
        cell.key = key(cell.at);
        cells.push_back(cell);
      }
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.key < b.key; });
  return cells;
}

// Each cell next to the one before, and no other cell between them.
TEST(HilbertKey, GoesFromCellToNeighbour) {
  for (uint32_t corner : {0u, 1u << 20, (1u << 21) - 16}) {
    const std::vector<Cell> cells = cubeAlong(hilbertKey, corner, 16);
    for (size_t i = 1; i < cells.size(); ++i) {
      uint32_t steps = 0;
      for (int k = 0; k < 3; ++k)
        steps += static_cast<uint32_t>(
            std::abs(static_cast<int>(cells[i].at[k]) - static_cast<int>(cells[i - 1].at[k])));
      EXPECT_EQ(steps, 1u) << i;
      EXPECT_EQ(cells[i].key, cells[i - 1].key + 1);
    }
  }
}

TEST(MortonKey, GoesThroughOctantAfterOctant) {
  const std::vector<Cell> cells = cubeAlong(mortonKey, 1u << 20, 8);
  for (size_t i = 0; i < cells.size(); ++i) {
    uint32_t wanted[3] = {};
    for (unsigned bit = 0; bit < 3; ++bit)
      for (unsigned k = 0; k < 3; ++k)
        wanted[k] |= (static_cast<uint32_t>(i) >> (3 * bit + 2 - k) & 1u) << bit;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(cells[i].at[k] - (1u << 20), wanted[k]) << i;
  }
}

TEST(BoxGrid, FitsTheBox) {
  const double low[3] = {-1, 5, 0}, high[3] = {1, 9, 1}, outside[3] = {7, 4, 99};
  const BoxGrid grid(low, high);
  uint32_t cell[3];
  grid.cellOf(low, cell);
  for (uint32_t c : cell) EXPECT_EQ(c, 0u);
  grid.cellOf(high, cell);
  EXPECT_EQ(cell[0], 1u << 20);  // cubes, as the longest side has them
  EXPECT_EQ(cell[1], (1u << 21) - 1);
  EXPECT_EQ(cell[2], 1u << 19);
  grid.cellOf(outside, cell);
  EXPECT_EQ(cell[1], 0u);
  EXPECT_EQ(cell[2], (1u << 21) - 1);
}

// Bricks one after the other, the longest side last; as many as asked for, about.
TEST(BoxGrid, CutsBricks) {
  const double low[3] = {0, 0, 0}, high[3] = {1, 4, 2};
  BoxGrid grid(low, high);
  grid.setBricks(8000, 125);
  std::set<uint64_t> keys;
  uint64_t last = 0;
  for (int y = 0; y < 40; ++y)
    for (int z = 0; z < 20; ++z)
      for (int x = 0; x < 10; ++x) {
        const double place[3] = {0.1 * x + 0.05, 0.1 * y + 0.05, 0.1 * z + 0.05};
        keys.insert(grid.brickKey(place));
      }
  for (uint64_t key : keys) last = std::max(last, key);
  EXPECT_EQ(keys.size(), 64u);
  EXPECT_EQ(last, 63u);
  const double first[3] = {0, 3.9, 0}, second[3] = {0.9, 0.1, 1.9};
  EXPECT_GT(grid.brickKey(first), grid.brickKey(second));
}

TEST(BoxGrid, TakesABoxOfNothing) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double low[3] = {infinity, infinity, infinity}, high[3] = {-infinity, -infinity, -infinity};
  BoxGrid grid(low, high);
  grid.setBricks(0, 500);
  const double place[3] = {0, 0, 0};
  EXPECT_EQ(grid.brickKey(place), 0u);
}

TEST(BoxGrid, TakesFlatAndEmptyBoxes) {
  const double point[3] = {3, 3, 3}, flat[3] = {4, 5, 3};
  uint32_t cell[3];
  for (const double* high : {point, flat}) {
    BoxGrid grid(point, high);
    grid.setBricks(1000, 10);
    grid.cellOf(high, cell);
    EXPECT_EQ(cell[2], 0u);
    EXPECT_LT(grid.brickKey(high), 200u);
  }
}

}  // namespace
}  // namespace tetstream::test
