// The minimum of an edge against a dense solution, and the same bits from every build.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "dense_testing.h"
#include "kernel_builds.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

// Two random positive definite quadrics, of condition about `1 / floor`.
template <class S>
struct Edge {
  Edge(Random& r, QuadricLayout its_layout, size_t n, double floor, size_t rank)
      : layout(its_layout), scale(n), x1(n), x2(n), z(n) {
    for (auto* q : {&q1, &q2})
      *q = packed<S>(layout, randomForm(r, layout, n, floor, rank), std::fabs(uniform(r)));
    for (size_t i = 0; i < n; ++i) {
      scale[i] = static_cast<S>(std::exp2(2 * uniform(r)));
      x1[i] = static_cast<S>(uniform(r));
      x2[i] = static_cast<S>(uniform(r));
    }
  }
  int n() const { return static_cast<int>(scale.size()); }
  S minimize() {
    return quadricKernels<S>(layout, n())
        .minimizeEdge(q1.data(), x1.data(), q2.data(), x2.data(), scale.data(), n(), z.data());
  }
  S solveDirectly() {
    return quadricKernels<S>(layout, n())
        .solveEdge(q1.data(), x1.data(), q2.data(), x2.data(), scale.data(), n(), z.data());
  }
  S errorAt(const std::vector<S>& at) const {
    return quadricKernels<S>(layout, n())
        .errorAt(q1.data(), x1.data(), q2.data(), x2.data(), scale.data(), n(), at.data());
  }
  Vector half() const {
    Vector h;
    for (size_t i = 0; i < scale.size(); ++i)
      h.push_back(0.5 * static_cast<double>(x2[i] - x1[i]) * static_cast<double>(scale[i]));
    return h;
  }
  // The error by the definition, z relative to the midpoint.
  double denseError(const Vector& at) const {
    const Vector h = half();
    Vector d1 = at, d2 = at;
    for (size_t i = 0; i < h.size(); ++i) d1[i] += h[i], d2[i] -= h[i];
    return static_cast<double>(q1.back()) + static_cast<double>(q2.back()) +
           formOf(matrix(q1), d1) + formOf(matrix(q2), d2);
  }
  // (A1 + A2) z = (A2 - A1) h over the first `rank` dimensions.
  Vector denseMinimum(size_t rank) const {
    const Matrix a = matrix(q1), b = matrix(q2);
    const Vector h = half();
    Matrix sum(rank, Vector(rank));
    Vector right(rank, 0.0);
    for (size_t i = 0; i < rank; ++i)
      for (size_t j = 0; j < rank; ++j) {
        sum[i][j] = a[i][j] + b[i][j];
        right[i] += (b[i][j] - a[i][j]) * h[j];
      }
    Vector at = solve(sum, right);
    at.resize(scale.size(), 0.0);
    return at;
  }
  Matrix matrix(const std::vector<S>& q) const { return denseOf(layout, q, scale.size()); }
  QuadricLayout layout;
  std::vector<S> q1, q2, scale, x1, x2, z;
};

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

// ---------------------------------------------------------------------------------- edgeErrors

// Vertices with quadrics, in rows that are wider than they must be.
template <class S>
struct Table {
  Table(Random& r, QuadricLayout layout, int n, uint32_t count)
      : quadric_stride(quadricSize(layout, n) + 1),
        value_stride(n + 2),
        scale(static_cast<size_t>(n)) {
    for (uint32_t v = 0; v < count; ++v) {
      const Edge<S> e(r, layout, static_cast<size_t>(n), v % 3 ? 0.1 : 0, static_cast<size_t>(n));
      quadrics.insert(quadrics.end(), e.q1.begin(), e.q1.end());
      values.insert(values.end(), e.x1.begin(), e.x1.end());
      quadrics.resize((v + 1) * static_cast<size_t>(quadric_stride), S(1e30));
      values.resize((v + 1) * static_cast<size_t>(value_stride), S(1e30));
      scale = e.scale;
    }
    quadrics.resize(quadrics.size() + 3);  // rows are read four numbers at a time
    values.resize(values.size() + 3);
  }
  VertexTable<S> view() const {
    return {quadrics.data(), values.data(), quadric_stride, value_stride};
  }
  int quadric_stride, value_stride;
  std::vector<S> scale, quadrics, values;
};

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
      for (int count = 0; count <= 20; ++count) {
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
      const Table<S> table(r, layout, n, 30);
      const VertexTable<S> view = table.view();
      for (size_t count = 1; count <= kEdgeLanes; ++count) {
        std::vector<uint32_t> ends(2 * count);
        for (uint32_t& end : ends) end = r.below(30);
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

// ---------------------------------------------------------------------------------- builds

template <class S>
void expectSameBits(const QuadricKernels<S>& a, const QuadricKernels<S>& b, QuadricLayout layout,
                    int n, Random& r) {
  const auto bytes = [](const std::vector<S>& v) { return v.size() * sizeof(S); };
  Corners<S> cell(r, layout, 4, n, false), other = cell, face(r, layout, 3, n, false),
                                           other_face = face;
  const auto addAll = [n](const QuadricKernels<S>& k, Corners<S>& c, Corners<S>& f) {
    c.template addWith<4>(
        [&](const S* const* x, S* const* q) { k.addCell(x, c.scale.data(), n, kShapeWeight, q); });
    f.template addWith<3>(
        [&](const S* const* x, S* const* q) { k.addFace(x, f.scale.data(), n, 300, q); });
  };
  addAll(a, cell, face);
  addAll(b, other, other_face);
  for (size_t i = 0; i < 4; ++i)
    EXPECT_EQ(
        0, std::memcmp(cell.quadrics[i].data(), other.quadrics[i].data(), bytes(cell.quadrics[i])));
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(0, std::memcmp(face.quadrics[i].data(), other_face.quadrics[i].data(),
                             bytes(face.quadrics[i])));
  Edge<S> e(r, layout, static_cast<size_t>(n), 0.01, static_cast<size_t>(n));
  std::vector<S> z1(static_cast<size_t>(n)), z2(static_cast<size_t>(n));
  const auto minimum = [&](const QuadricKernels<S>& k, std::vector<S>& z) {
    return k.minimizeEdge(e.q1.data(), e.x1.data(), e.q2.data(), e.x2.data(), e.scale.data(), n,
                          z.data());
  };
  EXPECT_EQ(minimum(a, z1), minimum(b, z2));
  EXPECT_EQ(0, std::memcmp(z1.data(), z2.data(), bytes(z1)));
  const auto errorOf = [&](const QuadricKernels<S>& k) {
    return k.errorAt(e.q1.data(), e.x1.data(), e.q2.data(), e.x2.data(), e.scale.data(), n,
                     e.q1.data());
  };
  EXPECT_EQ(errorOf(a), errorOf(b));
  const auto solved = [&](const QuadricKernels<S>& k, std::vector<S>& z) {
    return k.solveEdge(e.q1.data(), e.x1.data(), e.q2.data(), e.x2.data(), e.scale.data(), n,
                       z.data());
  };
  EXPECT_EQ(solved(a, z1), solved(b, z2));
  EXPECT_EQ(0, std::memcmp(z1.data(), z2.data(), bytes(z1)));
  if (n > 20) return;
  const Table<S> table(r, layout, n, 12);
  const uint32_t others[11] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
  std::vector<S> errors(16), other_errors(16);
  a.edgeErrors(table.view(), 0, others, 11, table.scale.data(), n, errors.data());
  b.edgeErrors(table.view(), 0, others, 11, table.scale.data(), n, other_errors.data());
  EXPECT_EQ(0, std::memcmp(errors.data(), other_errors.data(), bytes(errors)));
}

// quadricKernels gives the build for this processor.
TEST(QuadricKernels, GiveTheSameBitsFromEveryBuild) {
  Random r(14);
  for (QuadricLayout layout : kLayouts)
    for (int n : kDimensions)
      for (int round = 0; round < (slowRun() ? 2 : 50); ++round) {
        expectSameBits(plainKernelsFloat(layout, n), quadricKernels<float>(layout, n), layout, n,
                       r);
        expectSameBits(plainKernelsDouble(layout, n), quadricKernels<double>(layout, n), layout, n,
                       r);
      }
  RecordProperty("build", kernelBuild());
}

}  // namespace
}  // namespace tetstream::test
