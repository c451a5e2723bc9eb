// Many edges at once give the numbers of each.
#include <gtest/gtest.h>
#include <cstring>

#include "edge_testing.h"
#include "slow_run.h"

namespace tetstream::test {
namespace {

// The numbers of solveEdge, however many are asked for at once: in float bit by bit, in double as
// far as float32 goes of what is subtracted, the error at the midpoint.
void expectErrorOfSolveEdge(float one, float error, float) {
  EXPECT_EQ(0, std::memcmp(&one, &error, sizeof one)) << one << " and " << error;
}
void expectErrorOfSolveEdge(double one, double error, double at_midpoint) {
  EXPECT_NEAR(one, error, 1e-4 * at_midpoint);
}
template <class S>
void expectErrorsOfSolveEdge() {
  Random r(21);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 43}) {
      const auto& kernels = quadricKernels<S>(layout, n);
      const Table<S> table(r, layout, n, 30);
      const VertexTable<S> view = table.view();
      for (int count = 0; count <= 20; count += static_cast<int>(oneIn(n > 20 ? 10 : 3))) {
        std::vector<uint32_t> others(static_cast<size_t>(count));
        for (uint32_t& other : others) other = 1 + r.below(29);
        const int room = (count + kEdgeLanes - 1) / kEdgeLanes * kEdgeLanes;
        std::vector<S> errors(static_cast<size_t>(room) + 1, S(-7)), z(static_cast<size_t>(n));
        kernels.edgeErrors(view, 0, others.data(), count, table.scale.data(), n, errors.data());
        EXPECT_EQ(errors.back(), S(-7)) << "written beyond the end";
        for (size_t k = 0; k < others.size(); ++k) {
          const S one = kernels.solveEdge(view.quadric(0), view.value(0), view.quadric(others[k]),
                                          view.value(others[k]), table.scale.data(), n, z.data());
          const std::vector<S> midpoint(static_cast<size_t>(n));
          SCOPED_TRACE(n);
          expectErrorOfSolveEdge(
              one, errors[k],
              kernels.errorAt(view.quadric(0), view.value(0), view.quadric(others[k]),
                              view.value(others[k]), table.scale.data(), n, midpoint.data()));
        }
      }
    }
}
TEST(ErrorsOfManyEdges, AreThoseOfEachInFloat) {
  expectErrorsOfSolveEdge<float>();
}
TEST(ErrorsOfManyEdges, AreNearThoseOfEachInDouble) {
  expectErrorsOfSolveEdge<double>();
}

// Edges between any vertices of a table, some of them more than once.
template <class S>
void expectSolutionsOfSolveEdge() {
  Random r(22);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 5, 6, 7, 8, 9, 10, 12, 20, 128}) {
      const auto size = static_cast<size_t>(n);
      const auto& kernels = quadricKernels<S>(layout, n);
      const uint32_t vertices = slowRun() && n > 20 ? 5 : 30;
      const Table<S> table(r, layout, n, vertices);
      const VertexTable<S> view = table.view();
      for (size_t count = 1; count <= kEdgeLanes; count += oneIn(7)) {
        std::vector<uint32_t> ends(2 * count);
        for (uint32_t& end : ends) end = r.below(vertices);
        std::vector<S> z(size * count + 1, S(-7)), errors(count + 1, S(-7)), one(size);
        kernels.solveEdges(view, ends.data(), static_cast<int>(count), table.scale.data(), n,
                           z.data(), errors.data());
        EXPECT_EQ(z.back(), S(-7)) << "written beyond the end";
        EXPECT_EQ(errors.back(), S(-7)) << "written beyond the end";
        for (size_t k = 0; k < count; ++k) {
          const uint32_t u = ends[2 * k], v = ends[2 * k + 1];
          const S error = kernels.solveEdge(view.quadric(u), view.value(u), view.quadric(v),
                                            view.value(v), table.scale.data(), n, one.data());
          EXPECT_EQ(0, std::memcmp(&error, &errors[k], sizeof error)) << "n = " << n;
          EXPECT_EQ(0, std::memcmp(one.data(), &z[size * k], size * sizeof(S))) << "n = " << n;
        }
      }
    }
}
TEST(SolutionsOfManyEdges, AreThoseOfEach) {
  expectSolutionsOfSolveEdge<float>();
  expectSolutionsOfSolveEdge<double>();
}

}  // namespace
}  // namespace tetstream::test
