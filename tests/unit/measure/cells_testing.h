// Shared by the tests of measuring: cells by their corners, rows of them.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "random_simplex.h"
#include "row_number.h"
#include "simplex_rows.h"
#include "vector3.h"

namespace tetstream::test {

using Cell = std::vector<double>;  // corners
const Cell kCorner = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
constexpr double kCornerVolume = 1.0 / 6;

inline double volumeOf(const Cell& c) {
  return std::fabs(sixVolume(&c[0], &c[3], &c[6], &c[9])) / 6;
}

inline Cell moved(Cell cell, double x, double y, double z, double scale = 1) {
  for (size_t i = 0; i < 12; i += 3) {
    cell[i] = scale * cell[i] + x;
    cell[i + 1] = scale * cell[i + 1] + y;
    cell[i + 2] = scale * cell[i + 2] + z;
  }
  return cell;
}

// Values at a place.
using Values = std::function<std::vector<double>(const double*)>;

// Cells or triangles with the values of their corners. Above the limit they are in a file.
inline std::unique_ptr<SimplexRows> rowsOf(const std::vector<std::vector<double>>& simplices,
                                           RowShape shape, const Values& values, Account& account,
                                           size_t in_core_bytes = 1 << 24) {
  auto rows = std::make_unique<SimplexRows>(shape, RowBudget{account, "", in_core_bytes});
  for (std::vector<double> row : simplices) {
    for (size_t corner = 0; corner < shape.corners; ++corner) {
      const std::vector<double> there = values(row.data() + 3 * corner);
      row.insert(row.end(), there.begin(), there.end());
    }
    rows->add(row.data());
  }
  rows->finish();
  return rows;
}

inline std::vector<double> noValues(const double*) {
  return {};
}

}  // namespace tetstream::test
