// Splitting cells: the faces of neighbours are cut alike, the parts fill the cell.
#include "cell_kinds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <vector>

namespace tetstream {
namespace {

using Triangle = std::array<int64_t, 3>;

// How many of the tetrahedra have each triangle.
std::map<Triangle, int> trianglesOf(const std::vector<std::array<int64_t, 4>>& cells) {
  std::map<Triangle, int> found;
  for (const auto& c : cells)
    for (size_t j = 0; j < 4; ++j) {
      Triangle t = {c[(j + 1) % 4], c[(j + 2) % 4], c[(j + 3) % 4]};
      std::sort(t.begin(), t.end());
      ++found[t];
    }
  return found;
}

void split(CellShape shape, const std::vector<int64_t>& corners,
           std::vector<std::array<int64_t, 4>>& out) {
  int64_t made[kMostSplit][4];
  const size_t count = splitCell(shape, corners.data(), made);
  for (size_t i = 0; i < count; ++i)
    out.push_back({made[i][0], made[i][1], made[i][2], made[i][3]});
}

// A block of 3 x 3 x 3 hexahedra whose points are numbered at random: every triangle inside must
// have two tetrahedra, and the boundary has two triangles for each square.
TEST(CellKinds, NeighboursAgreeOnTheirFacesWhateverTheNumbers) {
  constexpr int64_t n = 3;
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::vector<int64_t> number((n + 1) * (n + 1) * (n + 1));
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), std::mt19937(seed));
    const auto at = [&](int64_t x, int64_t y, int64_t z) {
      return number[static_cast<size_t>(x + (n + 1) * (y + (n + 1) * z))];
    };
    std::vector<std::array<int64_t, 4>> cells;
    for (int64_t x = 0; x < n; ++x)
      for (int64_t y = 0; y < n; ++y)
        for (int64_t z = 0; z < n; ++z) {
          const std::vector<int64_t> bottom = {at(x, y, z), at(x + 1, y, z), at(x + 1, y + 1, z),
                                               at(x, y + 1, z)};
          const std::vector<int64_t> top = {at(x, y, z + 1), at(x + 1, y, z + 1),
                                            at(x + 1, y + 1, z + 1), at(x, y + 1, z + 1)};
          // Rows along y of hexahedra and of pairs of prisms, whose triangles meet in the rows.
          if ((x + z) % 2 == 0) {
            split(CellShape::kHexa,
                  {bottom[0], bottom[1], bottom[2], bottom[3], top[0], top[1], top[2], top[3]},
                  cells);
            continue;
          }
          split(CellShape::kPrism, {bottom[0], bottom[1], top[0], bottom[3], bottom[2], top[3]},
                cells);
          split(CellShape::kPrism, {bottom[1], top[1], top[0], bottom[2], top[2], top[3]}, cells);
        }
    size_t boundary = 0;
    for (const auto& [triangle, count] : trianglesOf(cells)) {
      EXPECT_LE(count, 2);
      boundary += count == 1;
    }
    EXPECT_EQ(boundary, 6u * n * n * 2u);
  }
}

TEST(CellKinds, EveryNumberingFillsTheCell) {
  const double hexa[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                             {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const double prism[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const double pyramid[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  const struct {
    CellShape shape;
    const double (*points)[3];
    double volume;
  } cases[] = {{CellShape::kHexa, hexa, 1},
               {CellShape::kPrism, prism, 0.5},
               {CellShape::kPyramid, pyramid, 1.0 / 3}};
  for (const auto& c : cases) {
    std::vector<int64_t> corners(static_cast<size_t>(cornersOf(c.shape)));
    std::iota(corners.begin(), corners.end(), 0);
    for (unsigned seed = 0; seed < 100; ++seed) {
      std::shuffle(corners.begin(), corners.end(), std::mt19937(seed));
      std::vector<std::array<int64_t, 4>> cells;
      split(c.shape, corners, cells);
      double sum = 0;
      for (const auto& cell : cells) {
        double e[4][3];
        for (size_t j = 0; j < 4; ++j) {
          const auto place = static_cast<size_t>(
              std::find(corners.begin(), corners.end(), cell[j]) - corners.begin());
          for (size_t k = 0; k < 3; ++k) e[j][k] = c.points[place][k];
        }
        for (size_t j = 1; j < 4; ++j)
          for (size_t k = 0; k < 3; ++k) e[j][k] -= e[0][k];
        const double volume = (e[1][0] * (e[2][1] * e[3][2] - e[2][2] * e[3][1]) -
                               e[1][1] * (e[2][0] * e[3][2] - e[2][2] * e[3][0]) +
                               e[1][2] * (e[2][0] * e[3][1] - e[2][1] * e[3][0])) /
                              6;
        EXPECT_GT(volume, 0);
        sum += volume;
      }
      EXPECT_NEAR(sum, c.volume, 1e-12);
    }
  }
}

TEST(CellKinds, LeavesOutWhatACollapsedCellHasLost) {
  std::vector<std::array<int64_t, 4>> cells;
  split(CellShape::kHexa, {0, 1, 2, 2, 3, 4, 5, 5}, cells);  // a prism
  EXPECT_EQ(cells.size(), 3u);
}

}  // namespace
}  // namespace tetstream
