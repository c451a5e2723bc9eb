// Ways through the cells of a window: to the cell that holds a place, or out of the mesh.
#include "cell_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "barycentric.h"
#include "random.h"
#include "shapes.h"

namespace tetstream::test {
namespace {

struct Walked {
  explicit Walked(const TestMesh& mesh)
      : window(account, {3, 1, 0, 0, 0}, mesh.cellCount(), mesh.vertexCount(), false),
        walk(account) {
    for (uint32_t v = 0; v < mesh.vertexCount(); ++v) {
      window.mesh.addVertex(kFinal);
      for (int i = 0; i < 3; ++i) window.values(v)[i] = mesh.position(v, i);
    }
    for (size_t c = 0; c < mesh.cellCount(); ++c) {
      uint32_t corners[4];
      for (size_t j = 0; j < 4; ++j) corners[j] = static_cast<uint32_t>(mesh.cells[4 * c + j]);
      window.mesh.addCell(corners, 0);
    }
    start();
  }
  void start() {
    std::vector<uint32_t> uses(window.mesh.vertexEnd());
    for (uint32_t c = 0; c < window.cellEnd(); ++c)
      for (uint32_t j = 0; j < 4 && window.isLive(c); ++j) ++uses[window.vertexOf(c, j)];
    walk.start(window, uses.data());
  }
  double leastWeight(uint32_t cell, const double x[3]) const {
    double corners[4][3], w[4];
    cornersIn(window, cell, corners);
    barycentricWeights(corners, x, w);
    return *std::min_element(w, w + 4);
  }
  void centroid(uint32_t cell, double x[3]) const {
    double corners[4][3];
    cornersIn(window, cell, corners);
    for (int i = 0; i < 3; ++i)
      x[i] = (corners[0][i] + corners[1][i] + corners[2][i] + corners[3][i]) / 4;
  }

  Account account;
  Window<double> window;
  CellWalk<double> walk;
};

TEST(CellWalk, LeadsFromEveryCellToTheOneThatHoldsThePlace) {
  const Walked w(fullGrid(5, 4, 6, 0.1));
  Random random(1);
  for (uint32_t cell = 0; cell < w.window.cellEnd(); ++cell) {
    double x[3];
    w.centroid(static_cast<uint32_t>(random.below(w.window.cellEnd())), x);
    EXPECT_GE(w.leastWeight(w.walk.from(cell, x), x), 0);
  }
}

// Of a box the faces that a place outside lies beyond are on the boundary.
TEST(CellWalk, LeadsToTheBoundaryBesideAPlaceOutside) {
  const Walked w(fullGrid(4, 4, 4));
  const double x[3] = {1.3, 2.2, 9};
  for (uint32_t cell = 0; cell < w.window.cellEnd(); ++cell) {
    const uint32_t end = w.walk.from(cell, x);
    double corners[4][3], above = 0;
    cornersIn(w.window, end, corners);
    for (const auto& corner : corners) above += corner[2] == 4;
    EXPECT_EQ(above, 3);
  }
}

// As into another body, or past a cell that has left.
TEST(CellWalk, GoesThroughLiveCellsOnly) {
  Walked w(fullGrid(1, 1, 8));
  double x[3];
  w.centroid(0, x);
  const uint32_t last = w.window.cellEnd() - 1;
  EXPECT_EQ(w.walk.from(last, x), 0u);
  for (uint32_t c = 0; c <= last; ++c) {
    double middle[3];
    w.centroid(c, middle);
    if (middle[2] > 4 && middle[2] < 5) w.window.mesh.kill(c);
  }
  w.start();
  const uint32_t end = w.walk.from(last, x);
  double middle[3];
  w.centroid(end, middle);
  EXPECT_TRUE(w.window.isLive(end));
  EXPECT_GT(middle[2], 5);
  EXPECT_LT(w.leastWeight(end, x), 0);
}

}  // namespace
}  // namespace tetstream::test
