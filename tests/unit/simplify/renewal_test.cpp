// Quadrics made anew are those of the cells, sheets and curves that are there, and of nothing else;
// simplification by them has smaller errors.
#include "renewal.h"

#include <cmath>

#include "field_error.h"
#include "settled.h"
#include "window_testing.h"

namespace tetstream::test {
namespace {

// Every free vertex is stale, though nothing has changed.
template <class S>
struct Stale : WholePatch<S> {
  explicit Stale(const TestMesh& the_mesh, const SimplifyOptions& the_options = {},
                 const FaceLabels& labels = {})
      : WholePatch<S>(the_mesh, the_options, labels),
        renewal(this->core, this->patch, this->account) {
    for (uint32_t v : this->owned) outdate(this->core.window, v);
  }
  size_t size() { return static_cast<size_t>(this->core.window.shape().quadric); }
  // The largest difference to what the stream gave, in the largest number of that quadric.
  double difference() {
    renewal.renewStale();
    double worst = 0;
    for (uint32_t v = 0; v < this->patch.ownedEnd(); ++v) {
      const S* given = this->core.window.quadric(this->owned[v]);
      double largest = 0, off = 0;
      for (size_t i = 0; i < size(); ++i) {
        largest = std::max(largest, std::fabs(static_cast<double>(given[i])));
        off = std::max(off, std::fabs(static_cast<double>(this->patch.quadric(v)[i] - given[i])));
      }
      worst = std::max(worst, off / largest);
    }
    return worst;
  }
  Renewal<S> renewal;
};

TestMesh wavyGrid(int n, ScalarType type = ScalarType::kFloat64) {
  TestMesh mesh = fullGrid(n, n, n, 0.1, type);
  addPositionField(mesh, {"f", 1, type}, [](double x, double y, double z) {
    return std::sin(0.7 * x) * y + 0.1 * z * z;
  });
  return mesh;
}

double middleOf(const TestMesh& mesh, size_t cell, int axis) {
  double sum = 0;
  for (size_t j = 0; j < 4; ++j)
    sum += mesh.position(static_cast<size_t>(mesh.cells[4 * cell + j]), axis) / 4;
  return sum;
}

// Four regions meet in a line.
void addQuarters(TestMesh& mesh, double half) {
  mesh.addIntegerCellData("material", [&](size_t c) {
    return int64_t{2} * (middleOf(mesh, c, 0) < half) + (middleOf(mesh, c, 1) < half);
  });
}

TEST(Renewal, WithoutAChangeGivesWhatTheStreamGave) {
  Stale<double> in_double(wavyGrid(5));
  ASSERT_GT(in_double.owned.size(), 100u);
  EXPECT_LT(in_double.difference(), 1e-12);
  Stale<float> in_float(wavyGrid(5, ScalarType::kFloat32));
  EXPECT_LT(in_float.difference(), 1e-5);
}

TEST(Renewal, KnowsInterfacesAndTheirCurves) {
  TestMesh mesh = wavyGrid(6);
  addQuarters(mesh, 3);
  Stale<double> s(mesh);
  ASSERT_TRUE(s.core.interfaces);
  ASSERT_FALSE(s.core.window.curves.empty());
  EXPECT_LT(s.difference(), 1e-12);
}

TEST(Renewal, KnowsRidges) {
  SimplifyOptions options;
  options.feature_angle = 40;
  Stale<double> s(wavyGrid(5), options);
  ASSERT_FALSE(s.core.window.curves.empty());
  EXPECT_LT(s.difference(), 1e-12);
}

// A labelled square in the middle of the grid, with its rim.
TEST(Renewal, KnowsLabelledFacesInsideARegion) {
  TestMesh mesh = fullGrid(6, 6, 6);
  FaceLabels labels;
  for (const auto& [face, cells] : facesOf(mesh.cells)) {
    bool in_square = cells == 2;
    for (int64_t v : face)
      for (int i = 0; i < 3; ++i) {
        const double off = std::fabs(mesh.position(static_cast<size_t>(v), i) - 3);
        in_square = in_square && (i == 2 ? off == 0 : off <= 2);
      }
    if (in_square) labels[face] = 7;
  }
  ASSERT_EQ(labels.size(), 32u);
  addPositionField(mesh, {"f", 1, ScalarType::kFloat64},
                   [](double x, double y, double z) { return x * y + z * z; });
  Stale<double> s(mesh, {}, labels);
  ASSERT_TRUE(s.core.inner_sheets);
  EXPECT_LT(s.difference(), 1e-12);
}

TEST(Renewal, LeavesVerticesThatAreNotStale) {
  Stale<double> s(wavyGrid(4));
  const uint32_t kept = s.owned[3], made = s.owned[4];
  settle(s.core.window, kept, {1, false, false});
  s.patch.quadric(3)[0] = s.patch.quadric(4)[0] = 1e30;
  s.renewal.renewStale();
  EXPECT_EQ(s.patch.quadric(3)[0], 1e30);
  EXPECT_NEAR(s.patch.quadric(4)[0], s.core.window.quadric(made)[0], 1e-9);
}

TEST(Renewal, ForgetsTheCellsThatWere) {
  Stale<double> s(wavyGrid(4));
  const size_t last = s.size() - 1;
  for (uint32_t v = 0; v < s.patch.ownedEnd(); ++v)
    for (size_t i = 0; i <= last; ++i) s.patch.quadric(v)[i] = 3;
  EXPECT_LT(s.difference(), 1e-12);
  for (uint32_t v = 0; v < s.patch.ownedEnd(); ++v) EXPECT_EQ(s.patch.quadric(v)[last], 0);
}

TEST(Renewal, LowersTheError) {
  const TestMesh mesh = wavyGrid(slowRun() ? 11 : 20);
  double errors[2];
  for (const bool renews : {false, true}) {
    SimplifyOptions options;
    options.ratio = 0.05;
    options.renews = renews;
    options.balance = BalanceUse::kNever;  // the same metric for both
    const Result result = simplified(mesh, options);
    EXPECT_TRUE(result.report.limited_by.empty()) << result.report.limited_by;
    errors[renews] = fieldErrors(mesh, result.out.mesh)[0];
  }
  EXPECT_LT(errors[1], 0.95 * errors[0]);
}

}  // namespace
}  // namespace tetstream::test
