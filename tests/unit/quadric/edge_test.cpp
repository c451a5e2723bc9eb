// The minimum of an edge against a dense solution.
#include <gtest/gtest.h>
#include <cmath>

#include "edge_testing.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

template <class S>
void expectDenseMinimum(double tolerance) {
  Random r(7);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 43})
      for (int round = 0; round < (slowRun() ? 3 : 50); ++round) {
        Edge<S> e(r, layout, static_cast<size_t>(n), 0.2, static_cast<size_t>(n));
        const auto error = static_cast<double>(e.minimize());
        const Vector wanted = e.denseMinimum(static_cast<size_t>(n));
        const double least = e.denseError(wanted);
        EXPECT_NEAR(error, least, tolerance * least) << "n = " << n;
        const double size = std::sqrt(dotOf(e.half(), e.half()));
        for (size_t i = 0; i < wanted.size(); ++i)
          EXPECT_NEAR(static_cast<double>(e.z[i]), wanted[i], 30 * tolerance * size) << "n = " << n;
        EXPECT_GE(e.minimize(), e.q1.back() + e.q2.back());
        EXPECT_EQ(e.minimize(), e.errorAt(e.z));
      }
}
TEST(MinimumOfAnEdge, IsTheDenseOneInDouble) {
  expectDenseMinimum<double>(1e-10);
}
TEST(MinimumOfAnEdge, IsTheDenseOneInFloat) {
  expectDenseMinimum<float>(3e-5);
}

// Nothing determines the dimensions beyond the rank: the midpoint is kept there, exactly.
template <class S>
void expectMidpointInTheNullSpace(double tolerance) {
  Random r(8);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 43})
      for (size_t rank : lowRanks(layout, n))
        for (int round = 0; round < 5; ++round) {
          Edge<S> e(r, layout, static_cast<size_t>(n), 0.2, rank);
          const auto error = static_cast<double>(e.minimize());
          const Vector wanted = e.denseMinimum(rank);
          const double size = std::sqrt(dotOf(e.half(), e.half()));
          for (size_t i = 0; i < wanted.size(); ++i)
            EXPECT_NEAR(static_cast<double>(e.z[i]), wanted[i], i < rank ? tolerance * size : 0);
          EXPECT_NEAR(error, e.denseError(wanted), tolerance * (1 + error));
        }
}
TEST(MinimumOfAnEdge, StaysAtTheMidpointWhereNothingDeterminesIt) {
  expectMidpointInTheNullSpace<double>(1e-9);
  expectMidpointInTheNullSpace<float>(2e-3);
}

// A direction that is determined 10^6 times worse than the others is not followed.
TEST(MinimumOfAnEdge, IsNotDrawnAwayByNearlySingularDirections) {
  Random r(9);
  constexpr QuadricLayout layout = QuadricLayout::kFull;
  Edge<double> e(r, layout, 3, 0, 3);
  e.q1 = packed<double>(layout, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1e-6}}, 0);
  e.q2 = packed<double>(layout, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1e-9}}, 0);
  e.minimize();
  EXPECT_LT(std::fabs(e.z[2]), 1e-3 * std::fabs(e.half()[2]));
}

// Both quadrics alike: the midpoint. All zero: the midpoint, at no cost.
TEST(MinimumOfAnEdge, IsTheMidpointOfEqualQuadrics) {
  Random r(10);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 9}) {
      Edge<double> e(r, layout, static_cast<size_t>(n), 0.1, static_cast<size_t>(n));
      e.q2 = e.q1;
      e.minimize();
      for (double z : e.z) EXPECT_EQ(z, 0);
      std::fill(e.q1.begin(), e.q1.end(), 0.0);
      e.q2 = e.q1;
      EXPECT_EQ(e.minimize(), 0);
      for (double z : e.z) EXPECT_EQ(z, 0);
    }
}

// Halving the user's unit doubles the scale: not a bit of z or of the error changes.
void expectNoUnits(uint64_t seed, float (Edge<float>::*minimum)()) {
  Random r(seed);
  for (QuadricLayout layout : kLayouts)
    for (int n : {4, 9})
      for (double unit : {0x1p20, 0x1p-20, 0x1p60}) {
        Edge<float> e(r, layout, static_cast<size_t>(n), 0.1, static_cast<size_t>(n));
        const float error = (e.*minimum)();
        const std::vector<float> z = e.z;
        for (size_t i = 0; i < e.scale.size(); ++i) {
          e.x1[i] *= static_cast<float>(unit);
          e.x2[i] *= static_cast<float>(unit);
          e.scale[i] /= static_cast<float>(unit);
        }
        EXPECT_EQ((e.*minimum)(), error);
        EXPECT_TRUE(e.z == z);
      }
}
TEST(MinimumOfAnEdge, DoesNotDependOnUnits) {
  expectNoUnits(11, &Edge<float>::minimize);
}

TEST(MinimumOfAnEdge, IsNeverBelowTheErrorsItStartsFrom) {
  Random r(12);
  for (int round = 0; round < (slowRun() ? 50 : 2000); ++round) {
    const size_t n = 3 + r.below(6);
    const QuadricLayout layout = kLayouts[r.below(2)];
    // Not even positive semidefinite: what rounding may leave of a sum of quadrics.
    Edge<float> e(r, layout, n, -0.05, n);
    const float error = e.minimize();
    EXPECT_FALSE(error < e.q1.back() + e.q2.back());
    EXPECT_FALSE(e.errorAt(e.z) < e.q1.back() + e.q2.back());
  }
}

TEST(MinimumOfAnEdge, IsNotFiniteWhereTheArithmeticOverflows) {
  Random r(13);
  Edge<float> e(r, QuadricLayout::kFields, 4, 0.2, 4);
  for (float& q : e.q1) q *= 1e38f;
  for (float& x : e.x1) x *= 1e19f;
  const float error = e.minimize();
  EXPECT_FALSE(std::isfinite(error));
}

// ---------------------------------------------------------------------------------- solveEdge

// Off the minimum by the ridge alone: less than a share of 1e-4 in the error where the quadrics
// determine all.
template <class S>
void expectSolved(double tolerance) {
  Random r(15);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 43})
      for (int round = 0; round < (slowRun() ? 3 : 50); ++round) {
        Edge<S> e(r, layout, static_cast<size_t>(n), 0.2, static_cast<size_t>(n));
        const auto least = static_cast<double>(e.minimize());
        const auto error = static_cast<double>(e.solveDirectly());
        EXPECT_NEAR(error, least, 1e-4 * least) << "n = " << n;
        EXPECT_GE(error, least * (1 - tolerance)) << "n = " << n;
        EXPECT_NEAR(error, static_cast<double>(e.errorAt(e.z)), tolerance * error);
        const Vector wanted = e.denseMinimum(static_cast<size_t>(n));
        const double size = std::sqrt(dotOf(e.half(), e.half()));
        for (size_t i = 0; i < wanted.size(); ++i)
          EXPECT_NEAR(static_cast<double>(e.z[i]), wanted[i], 2e-3 * size) << "n = " << n;
      }
}
TEST(SolvedEdge, HasTheErrorOfTheMinimum) {
  expectSolved<double>(1e-12);
  expectSolved<float>(3e-5);
}

// No place nearby is better by more than the ridge would cost there.
TEST(SolvedEdge, IsNotBeatenNearby) {
  Random r(16);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 6, 8})
      for (int round = 0; round < (slowRun() ? 3 : 50); ++round) {
        Edge<double> e(r, layout, static_cast<size_t>(n), 0.1, static_cast<size_t>(n));
        const double error = e.solveDirectly();
        const Vector at = e.z;
        const double size = std::sqrt(dotOf(e.half(), e.half()));
        for (int k = 0; k < 40; ++k) {
          const Vector step = randomVector(r, static_cast<size_t>(n), size * std::exp2(-k / 4.0));
          for (size_t i = 0; i < at.size(); ++i) e.z[i] = at[i] + step[i];
          EXPECT_GE(e.errorAt(e.z), error * (1 - 1e-4)) << "n = " << n;
        }
      }
}

// After a step in space no other values of the fields are better, and the error has grown by the
// form of space; full quadrics leave the fields.
TEST(SolvedEdge, HasFieldsThatFollowAStep) {
  Random r(18);
  for (int n : {3, 4, 6, 8, 11})
    for (int round = 0; round < (slowRun() ? 3 : 50); ++round) {
      const auto size = static_cast<size_t>(n);
      Edge<double> e(r, QuadricLayout::kFields, size, 0.1, size);
      const QuadricKernels<double>& kernels = quadricKernels<double>(e.layout, n);
      e.minimize();
      const double least = e.errorAt(e.z);
      const Vector before = e.z, step = randomVector(r, 3, 1);
      double form[6];
      kernels.spaceForm(e.q1.data(), e.q2.data(), n, form);
      for (size_t i = 0; i < 3; ++i) e.z[i] += step[i];
      kernels.followStep(e.q1.data(), e.q2.data(), n, step.data(), e.z.data());
      for (size_t i = 0; i < 3; ++i) EXPECT_EQ(e.z[i], before[i] + step[i]);
      const double error = e.errorAt(e.z);
      const double growth = form[0] * step[0] * step[0] + form[2] * step[1] * step[1] +
                            form[5] * step[2] * step[2] +
                            2 * (form[1] * step[0] * step[1] + form[3] * step[0] * step[2] +
                                 form[4] * step[1] * step[2]);
      EXPECT_NEAR(error - least, growth, 1e-3 * growth) << "n = " << n;
      for (size_t f = 3; f < size; ++f)
        for (double change : {-0.01, 0.01}) {
          Vector other = e.z;
          other[f] += change;
          EXPECT_GT(e.errorAt(other), error) << "n = " << n;
        }
    }
}

TEST(SolvedEdge, OfFullQuadricsHasFieldsThatStay) {
  Random r(19);
  Edge<double> e(r, QuadricLayout::kFull, 5, 0.1, 5);
  e.solveDirectly();
  const Vector before = e.z;
  quadricKernels<double>(e.layout, 5)
      .followStep(e.q1.data(), e.q2.data(), 5, e.x1.data(), e.z.data());
  EXPECT_EQ(e.z, before);
}

// What no quadric determines stays at the midpoint; equal quadrics, or none, give it too.
TEST(SolvedEdge, StaysAtTheMidpointWhereNothingDeterminesIt) {
  Random r(17);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 6, 9})
      for (size_t rank : lowRanks(layout, n)) {
        Edge<float> e(r, layout, static_cast<size_t>(n), 0.2, rank);
        const float error = e.solveDirectly();
        EXPECT_TRUE(std::isfinite(error));
        for (size_t i = rank; i < e.z.size(); ++i) EXPECT_EQ(e.z[i], 0) << "n = " << n;
        e.q2 = e.q1;
        e.solveDirectly();
        for (float z : e.z) EXPECT_EQ(z, 0);
      }
  Edge<double> none(r, QuadricLayout::kFields, 4, 0, 0);
  none.q1.assign(none.q1.size(), 0.0);
  none.q2 = none.q1;
  EXPECT_EQ(none.solveDirectly(), 0);
}

// Constant fields say nothing of the place, but what they are worth: the midpoint, at no cost.
TEST(SolvedEdge, IsTheMidpointWhereAllFieldsAreFlat) {
  Random r(24);
  for (int n : {4, 5, 9, 40}) {
    Corners<float> c(r, QuadricLayout::kFields, 4, n, true);
    for (auto& p : c.points) std::fill(p.begin() + 3, p.end(), 0.75f);
    c.addWith<4>([&](const float* const* x, float* const* q) {
      c.kernels().addCell(x, c.scale.data(), n, 0, q);
    });
    std::vector<float> z(static_cast<size_t>(n), 7.0f);
    EXPECT_EQ(c.kernels().solveEdge(c.quadrics[0].data(), c.points[0].data(), c.quadrics[1].data(),
                                    c.points[1].data(), c.scale.data(), n, z.data()),
              0);
    for (float at : z) EXPECT_EQ(at, 0) << "n = " << n;
  }
}

// A field that is the same linear one on both sides: its cells' quadrics meet at the line between.
TEST(SolvedEdge, KeepsALinearField) {
  Random r(18);
  for (int round = 0; round < (slowRun() ? 5 : 100); ++round) {
    Corners<double> c(r, QuadricLayout::kFields, 4, 5, true);
    const Vector g = randomVector(r, 3), h = randomVector(r, 3);
    const auto set = [&](std::vector<double>& p) {
      p[3] = g[0] * p[0] + g[1] * p[1] + g[2] * p[2] + 3;
      p[4] = h[0] * p[0] + h[1] * p[1] + h[2] * p[2] - 1;
    };
    for (auto& p : c.points) set(p);
    c.addWith<4>([&](const double* const* x, double* const* q) {
      c.kernels().addCell(x, c.scale.data(), 5, kShapeWeight, q);
    });
    double z[5];
    c.kernels().solveEdge(c.quadrics[0].data(), c.points[0].data(), c.quadrics[1].data(),
                          c.points[1].data(), c.scale.data(), 5, z);
    std::vector<double> merged(5), wanted;
    for (size_t i = 0; i < 5; ++i) merged[i] = 0.5 * (c.points[0][i] + c.points[1][i]) + z[i];
    wanted = merged;
    set(wanted);
    for (size_t i = 3; i < 5; ++i) EXPECT_NEAR(merged[i], wanted[i], 1e-9);
  }
}

TEST(SolvedEdge, DoesNotDependOnUnits) {
  expectNoUnits(19, &Edge<float>::solveDirectly);
}

TEST(SolvedEdge, IsNeverBelowTheErrorsItStartsFromAndNotFiniteIfItOverflows) {
  Random r(20);
  for (int round = 0; round < (slowRun() ? 50 : 2000); ++round) {
    const size_t n = 3 + r.below(6);
    const QuadricLayout layout = kLayouts[r.below(2)];
    Edge<float> e(r, layout, n, -0.05, n);  // what rounding may leave of a sum of quadrics
    EXPECT_FALSE(e.solveDirectly() < e.q1.back() + e.q2.back());
  }
  Edge<float> e(r, QuadricLayout::kFields, 4, 0.2, 4);
  for (float& q : e.q1) q *= 1e38f;
  for (float& x : e.x1) x *= 1e19f;
  EXPECT_FALSE(std::isfinite(e.solveDirectly()));
}

// The layout of fields leaves out nothing but zeros: the same numbers as from the whole triangle.
template <class S>
void expectNumbersOfTheTriangle() {
  Random r(23);
  for (int n : kDimensions)
    for (int round = 0; round < (slowRun() ? 2 : 20); ++round) {
      const auto size = static_cast<size_t>(n);
      Edge<S> fields(r, QuadricLayout::kFields, size, 0.1, round % 5 ? size : 3);
      Edge<S> full = fields;
      full.layout = QuadricLayout::kFull;
      full.q1 = packed<S>(full.layout, fields.matrix(fields.q1), double(fields.q1.back()));
      full.q2 = packed<S>(full.layout, fields.matrix(fields.q2), double(fields.q2.back()));
      EXPECT_EQ(fields.solveDirectly(), full.solveDirectly()) << "n = " << n;
      EXPECT_TRUE(fields.z == full.z) << "n = " << n;
      EXPECT_EQ(fields.errorAt(fields.z), full.errorAt(full.z)) << "n = " << n;
      EXPECT_EQ(fields.minimize(), full.minimize()) << "n = " << n;
      EXPECT_TRUE(fields.z == full.z) << "n = " << n;
    }
}
TEST(LayoutOfFields, GivesTheNumbersOfTheWholeTriangle) {
  expectNumbersOfTheTriangle<float>();
  expectNumbersOfTheTriangle<double>();
}

}  // namespace
}  // namespace tetstream::test
