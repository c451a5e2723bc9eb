// tests: how many cells of a result are thin.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "star_kernels.h"
#include "test_mesh.h"

namespace tetstream::test {

// Of the cells, those with a dihedral angle below, in degrees.
inline double shareBelow(const TestMesh& mesh, double degrees) {
  std::vector<double> places;
  for (size_t v = 0; v < mesh.vertexCount(); ++v)
    for (int i = 0; i < 4; ++i) places.push_back(i < 3 ? mesh.position(v, i) : 0);
  size_t thin = 0;
  for (size_t c = 0; c < mesh.cellCount(); ++c) {
    StarCell cell{};
    uint32_t v[4];
    for (size_t j = 0; j < 4; ++j) v[j] = static_cast<uint32_t>(mesh.cells[4 * c + j]);
    std::copy_n(v + 1, 3, cell.t);
    const ThinAngle angle(degrees);
    StarShape shape = starShape(&places[size_t{4} * v[0]], places.data(), 4, 1, &cell, 1, angle);
    if (!shape.positive) {
      std::swap(cell.t[0], cell.t[1]);
      shape = starShape(&places[size_t{4} * v[0]], places.data(), 4, 1, &cell, 1, angle);
    }
    EXPECT_TRUE(shape.positive);
    thin += shape.thin;
  }
  return static_cast<double>(thin) / static_cast<double>(mesh.cellCount());
}

}  // namespace tetstream::test
