// tests: what is promised holds in every mode, where cells are flipped and where they are parked.
#pragma once

#include <vector>

#include "simplify_testing.h"

namespace tetstream::test {

struct Way {
  Mode mode;
  Shape shape;
  double parked_times = 0;
  SimplifyOptions toRatio(double ratio, int64_t window = 0) const {
    SimplifyOptions options = test::toRatio(ratio, window, mode);
    options.shape = shape;
    options.parked_times = parked_times;
    return options;
  }
};
constexpr Way kWays[] = {{Mode::kSweep, Shape::kField},
                         {Mode::kSweep, Shape::kField, 2},
                         {Mode::kSweep, Shape::kSolver},
                         {Mode::kPaper, Shape::kField},
                         {Mode::kQueue, Shape::kField}};

// Flips take place where shapes come first, and nowhere else.
inline void expectFlips(const Report& report, const Way& way) {
  if (way.shape == Shape::kSolver)
    EXPECT_GT(report.flips, 0);
  else
    EXPECT_EQ(report.flips, 0);
}

// A full grid of n^3 cubes with its inside shaken, so that flips have something to do.
inline TestMesh shakenInside(int n) {
  const TestMesh grid = fullGrid(n, n, n), shaken = fullGrid(n, n, n, 0.25);
  std::vector<double> positions;
  for (size_t v = 0; v < grid.vertexCount(); ++v) {
    bool outside = false;
    for (int i = 0; i < 3; ++i) outside |= grid.position(v, i) <= 0 || grid.position(v, i) >= n;
    for (int i = 0; i < 3; ++i) positions.push_back((outside ? grid : shaken).position(v, i));
  }
  return makeMesh(ScalarType::kFloat64, positions, grid.cells);
}

}  // namespace tetstream::test
