// Release: which cells leave first.
#include <algorithm>
#include <cmath>
#include <limits>

#include "release.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

TestMesh bumpyGrid(int n, int layers) {
  TestMesh mesh = fullGrid(n, n, layers, 0.1);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64}, [](double x, double y, double z) {
    return std::sin(x) * std::cos(1.7 * y) + std::sin(0.4 * z);
  });
  return mesh;
}

SimplifyOptions releasing(ReleaseOrder order, double ratio = 0.3, int64_t window = 0,
                          Mode mode = SimplifyOptions().mode) {
  SimplifyOptions options = toRatio(ratio, window, mode);
  options.release = order;
  return options;
}

// The largest error of its edges, each solved by itself; all vertices are free.
double dearestEdge(WholeWindow<double>& w, uint32_t cell) {
  Window<double>& window = w.core.window;
  double dearest = 0, z[4];
  for (uint32_t i = 0; i < 4; ++i)
    for (uint32_t j = i + 1; j < 4; ++j) {
      const uint32_t u = window.vertexOf(cell, i), v = window.vertexOf(cell, j);
      dearest = std::max(
          dearest, w.core.kernels.solveEdge(window.quadric(u), window.values(u), window.quadric(v),
                                            window.values(v), w.core.scale.data(), 4, z));
    }
  return dearest;
}

struct Written {
  std::vector<double> errors;  // of the cells, as they were written
  double dearest_left = 0;
};

Written halfWritten(ReleaseOrder order) {
  WholeWindow<double> w(bumpyGrid(4, 4), releasing(order));
  std::vector<double> left;
  for (uint32_t c = 0; c < w.core.window.cellEnd(); ++c) left.push_back(dearestEdge(w, c));
  Recorder out;
  out.begin(w.plan.schema);
  Release<double> release(w.core, out, w.account);
  const auto half = static_cast<uint32_t>(left.size() / 2);
  release.write({half});
  release.flush();
  EXPECT_EQ(out.problem, "");
  EXPECT_EQ(release.cellsWritten(), left.size() - half);
  Written written;
  // By the positions of their vertices: ranks are those of the output.
  const auto corner = [](const TestMesh& mesh, size_t c, size_t j, int i) {
    return mesh.position(static_cast<size_t>(mesh.cells[4 * c + j]), i);
  };
  for (size_t c = 0; c < out.mesh.cellCount(); ++c)
    for (size_t k = 0; k < w.mesh.cellCount(); ++k) {
      bool same = true;
      for (size_t j = 0; j < 4; ++j)
        for (int i = 0; i < 3; ++i)
          same = same && corner(out.mesh, c, j, i) == corner(w.mesh, k, j, i);
      if (!same) continue;
      written.errors.push_back(left[k]);
      left[k] = 0;
    }
  EXPECT_EQ(written.errors.size(), out.mesh.cellCount());
  written.dearest_left = *std::max_element(left.begin(), left.end());
  return written;
}

TEST(Release, OfTheDearestCellsFirstLeavesTheCheapest) {
  const Written written = halfWritten(ReleaseOrder::kError);
  EXPECT_TRUE(std::is_sorted(written.errors.rbegin(), written.errors.rend()));
  EXPECT_LE(written.dearest_left, written.errors.back());
}

TEST(Release, IsInTheOrderOfArrivalUnlessAnotherIsAskedFor) {
  EXPECT_EQ(SimplifyOptions().release, ReleaseOrder::kArrival);
  const Written written = halfWritten(ReleaseOrder::kArrival);
  EXPECT_FALSE(std::is_sorted(written.errors.rbegin(), written.errors.rend()));
  EXPECT_GT(written.dearest_left, written.errors.back());
}

TEST(Release, OfTheDearestCellsGivesASoundMeshInEveryMode) {
  const TestMesh mesh = bumpyGrid(5, slowRun() ? 8 : 30);
  for (Mode mode : kModes) {
    const SimplifyOptions options = releasing(ReleaseOrder::kError, 0.5, 1200, mode);
    const Result result = simplified(mesh, options);
    expectSound(mesh, result);
    expectReached(result);
    EXPECT_EQ(topologyChange(factsOf(mesh), factsOf(result.out.mesh)), "");
    Cut cut;
    cut.batch_cells = 7;
    EXPECT_TRUE(simplified(mesh, options, cut).out.allBytes() == result.out.allBytes());
  }
}

// What is left behind is read from later: the front of the output is what the order costs.
TEST(Release, OfTheDearestCellsHasTheWiderFront) {
  const TestMesh mesh = bumpyGrid(5, slowRun() ? 16 : 60);
  const auto widthOf = [&](ReleaseOrder order) {
    const Result result = simplified(mesh, releasing(order, 0.5, 1200));
    std::vector<size_t> last(result.out.mesh.vertexCount());
    const TestMesh& out = result.out.mesh;
    for (size_t i = 0; i < out.cells.size(); ++i) last[static_cast<size_t>(out.cells[i])] = i / 4;
    size_t active = 0, widest = 0, seen = 0;
    for (size_t c = 0; c < out.cellCount(); ++c)
      for (size_t j = 0; j < 4; ++j) {
        const auto v = static_cast<size_t>(out.cells[4 * c + j]);
        if (v == seen) {
          ++seen;
          widest = std::max(widest, ++active);
        }
        active -= last[v] == c;
      }
    return widest;
  };
  EXPECT_GT(widthOf(ReleaseOrder::kError), widthOf(ReleaseOrder::kArrival));
}

}  // namespace
}  // namespace tetstream::test
