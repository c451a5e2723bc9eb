// Shared by the tests of differences of fields: two meshes whose values are functions of the place.
#pragma once

#include <gtest/gtest.h>
#include <algorithm>

#include "cells_testing.h"
#include "field_difference.h"

namespace tetstream::test {

constexpr RowShape kOneValue = {4, 1};
const std::vector<ComparedField> kOneField = {{0, 1, 1, 1}};

// A value that is linear in the place: at the origin, and by how much it grows along each axis.
inline Values linear(double at_origin, double x = 0, double y = 0, double z = 0) {
  return
      [=](const double* at) { return std::vector{at_origin + x * at[0] + y * at[1] + z * at[2]}; };
}

// The unit cube: so many cubes along each side, each of six cells, one for each way along the axes
// from a corner of it to the one across.
inline std::vector<Cell> cubeOf(int side) {
  std::vector<Cell> cells;
  int axes[3] = {0, 1, 2};
  do {
    for (int cube = 0; cube < side * side * side; ++cube) {
      int at[3] = {cube % side, cube / side % side, cube / side / side};
      Cell cell;
      for (int corner = 0; corner < 4; ++corner) {
        if (corner > 0) ++at[axes[corner - 1]];
        for (int k : at) cell.push_back(static_cast<double>(k) / side);
      }
      cells.push_back(cell);
    }
  } while (std::next_permutation(axes, axes + 3));
  return cells;
}

inline std::vector<Cell> moved(std::vector<Cell> cells, double x, double y, double z) {
  for (Cell& cell : cells) cell = moved(cell, x, y, z);
  return cells;
}

// One of the two meshes.
struct Valued {
  std::vector<Cell> cells;
  Values values;
};

struct Measuring {
  size_t in_core = 1 << 24, bytes = 1 << 24;  // of rows; of what is measured at once
  FieldDifference::Sampling sampling = {};
  const Tasks* tasks = nullptr;
};

// The difference of two meshes, and outside, where there is a surface, by that.
class Measured {
 public:
  Measured(const Valued& original, const Valued& simplified, const Valued& surface = {},
           const Measuring& how = {}, RowShape shape = kOneValue,
           const std::vector<ComparedField>& fields = kOneField)
      : difference_(fields, shape.values, how.sampling, {account_, "", how.bytes, how.tasks}) {
    const auto rows = [&](const Valued& mesh, size_t corners) {
      return rowsOf(mesh.cells, {corners, shape.values}, mesh.values, account_, how.in_core);
    };
    double shared = 0;
    const auto take = [&](double share) {
      EXPECT_GE(share, shared);
      steps_ += share > shared;
      shared = share;
    };
    difference_.measure(*rows(original, 4), *rows(simplified, 4), take);
    EXPECT_EQ(shared, original.cells.empty() ? 0 : 1);
    measured_steps_ = steps_;
    shared = 0;
    difference_.measureOutside(*rows(surface, 3), take);
  }
  int steps() const { return measured_steps_; }  // of what was told of the progress inside
  const VolumeSums& volumes() const { return difference_.volumes(); }
  const FieldSums& inside(size_t field = 0) const { return difference_.inside(field); }
  const FieldSums& outside(size_t field = 0) const { return difference_.outside(field); }

 private:
  Account account_;
  FieldDifference difference_;
  int steps_ = 0, measured_steps_ = 0;
};

inline void expectVolumes(const Measured& m, const VolumeSums& expected) {
  EXPECT_NEAR(m.volumes().original, expected.original, 1e-14);
  EXPECT_NEAR(m.volumes().covered, expected.covered, 1e-14);
  EXPECT_NEAR(m.volumes().outside, expected.outside, 1e-14);
  EXPECT_NEAR(m.volumes().twice, expected.twice, 1e-14);
}

inline void expectPlace(const FieldSums& sums, double x, double y, double z) {
  EXPECT_NEAR(sums.place[0], x, 1e-14);
  EXPECT_NEAR(sums.place[1], y, 1e-14);
  EXPECT_NEAR(sums.place[2], z, 1e-14);
}

}  // namespace tetstream::test
