// The quadric kernels against dense arithmetic written out: the integral of the squared error,
// distances to flats, minima of edges; and the same bits from every build.
#include "kernels.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "kernel_builds.h"
#include "random.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;

double uniform(Random& r) {
  return 2.0 * static_cast<double>(r.next() >> 11) * 0x1p-53 - 1;
}

Vector randomVector(Random& r, size_t n, double size = 1) {
  Vector v(n);
  for (double& x : v) x = size * uniform(r);
  return v;
}

double dotOf(const Vector& a, const Vector& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Gauss with pivots; the matrix is small and regular.
Vector solve(Matrix a, Vector b) {
  const size_t n = b.size();
  for (size_t k = 0; k < n; ++k) {
    size_t pivot = k;
    for (size_t i = k; i < n; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (size_t i = k + 1; i < n; ++i) {
      const double f = a[i][k] / a[k][k];
      for (size_t j = k; j < n; ++j) a[i][j] -= f * a[k][j];
      b[i] -= f * b[k];
    }
  }
  for (size_t k = n; k-- > 0;) {
    for (size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

template <class S>
Matrix denseOf(const std::vector<S>& q, size_t n) {
  Matrix a(n, Vector(n));
  for (size_t i = 0, k = 0; i < n; ++i)
    for (size_t j = 0; j <= i; ++j, ++k) a[i][j] = a[j][i] = static_cast<double>(q[k]);
  return a;
}

template <class S>
std::vector<S> packed(const Matrix& a, double error) {
  std::vector<S> q;
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j <= i; ++j) q.push_back(static_cast<S>(a[i][j]));
  q.push_back(static_cast<S>(error));
  return q;
}

double formOf(const Matrix& a, const Vector& d) {
  double sum = 0;
  for (size_t i = 0; i < d.size(); ++i) sum += d[i] * dotOf(a[i], d);
  return sum;
}

// Four (or three) points in R^n with their scales and quadrics, in the kernel's form.
template <class S>
struct Corners {
  Corners(Random& r, int count, int dimension, bool unit_scale) : n(dimension) {
    for (int i = 0; i < n; ++i)
      scale.push_back(static_cast<S>(unit_scale ? 1 : std::exp2(3 * uniform(r))));
    for (int k = 0; k < count; ++k) {
      std::vector<S> p;
      for (int i = 0; i < n; ++i) p.push_back(static_cast<S>(uniform(r)));
      points.push_back(p);
      quadrics.emplace_back(static_cast<size_t>(quadricSize(n)), S(0));
    }
  }
  // b - a in normalised units.
  Vector difference(const std::vector<S>& a, const std::vector<S>& b) const {
    Vector d;
    for (size_t i = 0; i < a.size(); ++i)
      d.push_back(static_cast<double>(b[i] - a[i]) * static_cast<double>(scale[i]));
    return d;
  }
  Vector edge(size_t k) const { return difference(points[0], points[k]); }
  template <int Count, class Add>
  void addWith(Add add) {
    const S* x[Count];
    S* q[Count];
    for (size_t k = 0; k < static_cast<size_t>(Count); ++k) {
      x[k] = points[k].data();
      q[k] = quadrics[k].data();
    }
    add(x, q);
  }
  int n;
  std::vector<S> scale;
  std::vector<std::vector<S>> points, quadrics;
};

double volumeOf(const Vector& a, const Vector& b, const Vector& c) {
  return std::fabs(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0])) /
         6;
}

const int kDimensions[] = {3, 4, 5, 6, 7, 9, 20, 128};

// The gradient of a field that has the differences `df` along the three edges in space.
Vector gradientOf(const Vector& e1, const Vector& e2, const Vector& e3, const Vector& df) {
  return solve({{e1[0], e1[1], e1[2]}, {e2[0], e2[1], e2[2]}, {e3[0], e3[1], e3[2]}}, df);
}

double spaceSquared(const Vector& d) {
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

// At any point x: a quarter of V sum over fields (g . dx - df)^2, and of the shape term.
template <class S>
void expectIntegral(double tolerance) {
  Random r(1);
  for (int n : kDimensions)
    for (int round = 0; round < (slowRun() ? 2 : 20); ++round) {
      Corners<S> c(r, 4, n, round % 2);
      c.template addWith<4>([&](const S* const* x, S* const* q) {
        quadricKernels<S>(n).addCellField(x, c.scale.data(), n, q);
      });
      const Vector e1 = c.edge(1), e2 = c.edge(2), e3 = c.edge(3);
      const double volume = volumeOf(e1, e2, e3);
      if (volume < 0.01 * std::pow(spaceSquared(e1) + spaceSquared(e2) + spaceSquared(e3), 1.5))
        continue;  // thin cells have a rule of their own
      const Matrix a = denseOf(c.quadrics[2], static_cast<size_t>(n));
      const Vector d = randomVector(r, static_cast<size_t>(n));
      double wanted = kShapeWeight * volume / 4 * spaceSquared(d), size = 0;
      for (size_t f = 3; f < static_cast<size_t>(n); ++f) {
        const Vector g = gradientOf(e1, e2, e3, {e1[f], e2[f], e3[f]});
        const double miss = g[0] * d[0] + g[1] * d[1] + g[2] * d[2] - d[f];
        wanted += volume / 4 * miss * miss;
        size += volume * (dotOf(g, g) * spaceSquared(d) + d[f] * d[f]);
      }
      EXPECT_NEAR(formOf(a, d), wanted, tolerance * (size + wanted)) << "n = " << n;
      for (const auto& q : c.quadrics) EXPECT_TRUE(q == c.quadrics[0]);  // a quarter each
      EXPECT_EQ(c.quadrics[0].back(), S(0));
    }
}
TEST(QuadricOfACell, IsTheIntegralOfTheSquaredErrorInDouble) {
  expectIntegral<double>(1e-12);
}
TEST(QuadricOfACell, IsTheIntegralOfTheSquaredErrorInFloat) {
  expectIntegral<float>(1e-6);
}

// Along the cell's hyperplane a linear field has no error: only the shape term is left.
TEST(QuadricOfACell, IsZeroForTheLinearExtension) {
  Random r(2);
  for (int n : {4, 6, 9}) {
    Corners<double> c(r, 4, n, true);
    c.addWith<4>([&](const double* const* x, double* const* q) {
      quadricKernels<double>(n).addCellField(x, c.scale.data(), n, q);
    });
    const Vector e1 = c.edge(1), e2 = c.edge(2), e3 = c.edge(3);
    const Matrix a = denseOf(c.quadrics[0], static_cast<size_t>(n));
    for (int round = 0; round < 10; ++round) {
      const double s = 3 * uniform(r), t = 3 * uniform(r), u = 3 * uniform(r);
      Vector d(static_cast<size_t>(n));
      for (size_t i = 0; i < d.size(); ++i) d[i] = s * e1[i] + t * e2[i] + u * e3[i];
      const double volume = volumeOf(e1, e2, e3);
      EXPECT_NEAR(formOf(a, d), kShapeWeight * volume / 4 * spaceSquared(d), 1e-9 * dotOf(d, d));
    }
  }
}

// A flat cell has no gradient; its quadric is bounded and no infinity gets into it.
TEST(QuadricOfACell, IsBoundedForFlatCells) {
  for (int n : {3, 4, 7, 9}) {
    Random r(3);
    Corners<float> c(r, 4, n, true);
    for (auto& p : c.points) p[2] = 0.5f;
    const auto add = {quadricKernels<float>(n).addCellField,
                      quadricKernels<float>(n).addCellDistance};
    for (auto kernel : add)
      c.addWith<4>(
          [&](const float* const* x, float* const* q) { kernel(x, c.scale.data(), n, q); });
    for (float v : c.quadrics[0]) EXPECT_LT(std::fabs(v), 1e6f);
  }
}

// The squared distance from the flat through a point along `edges`, by normal equations.
double distanceSquared(const std::vector<Vector>& edges, const Vector& d) {
  Matrix gram;
  Vector right;
  for (const Vector& e : edges) {
    gram.emplace_back();
    for (const Vector& other : edges) gram.back().push_back(dotOf(e, other));
    right.push_back(dotOf(e, d));
  }
  const Vector t = solve(gram, right);
  Vector rest = d;
  for (size_t k = 0; k < edges.size(); ++k)
    for (size_t i = 0; i < d.size(); ++i) rest[i] -= t[k] * edges[k][i];
  return dotOf(rest, rest);
}

TEST(QuadricOfGarlandAndZhou, IsTheDistanceToTheCellsHyperplane) {
  Random r(4);
  for (int n : kDimensions)
    for (int round = 0; round < (slowRun() ? 1 : 10); ++round) {
      Corners<double> c(r, 4, n, round % 2);
      c.addWith<4>([&](const double* const* x, double* const* q) {
        quadricKernels<double>(n).addCellDistance(x, c.scale.data(), n, q);
      });
      const Vector e1 = c.edge(1), e2 = c.edge(2), e3 = c.edge(3);
      const double volume = volumeOf(e1, e2, e3);
      if (volume < 0.01 * std::pow(spaceSquared(e1) + spaceSquared(e2) + spaceSquared(e3), 1.5))
        continue;
      const Vector d = randomVector(r, static_cast<size_t>(n));
      const double wanted = volume / 4 * (distanceSquared({e1, e2, e3}, d)) +
                            kShapeWeight * volume / 4 * spaceSquared(d);
      EXPECT_NEAR(formOf(denseOf(c.quadrics[1], static_cast<size_t>(n)), d), wanted,
                  1e-10 * volume * dotOf(d, d))
          << "n = " << n;
    }
}

// Three corners together have weight * area^(3/2) times the squared distance.
TEST(QuadricOfAFace, IsTheDistanceToItsPlaneOrFlat) {
  Random r(5);
  for (int n : kDimensions)
    for (int round = 0; round < (slowRun() ? 1 : 10); ++round) {
      Corners<double> c(r, 3, n, round % 2), flat = c;
      const auto size = static_cast<size_t>(n);
      c.addWith<3>([&](const double* const* x, double* const* q) {
        quadricKernels<double>(n).addFacePlane(x, c.scale.data(), n, 7, q);
      });
      flat.addWith<3>([&](const double* const* x, double* const* q) {
        quadricKernels<double>(n).addFaceDistance(x, c.scale.data(), n, 7, q);
      });
      const Vector e1 = c.edge(1), e2 = c.edge(2);
      const Vector s1(e1.begin(), e1.begin() + 3), s2(e2.begin(), e2.begin() + 3);
      const double area =
          0.5 * std::sqrt(dotOf(s1, s1) * dotOf(s2, s2) - std::pow(dotOf(s1, s2), 2));
      const Vector d = randomVector(r, size);
      const Vector in_space(d.begin(), d.begin() + 3);
      const double weight = 7 * std::pow(area, 1.5) / 3;
      EXPECT_NEAR(formOf(denseOf(c.quadrics[0], size), d),
                  weight * distanceSquared({s1, s2}, in_space), 1e-10 * weight * dotOf(d, d));
      EXPECT_NEAR(formOf(denseOf(flat.quadrics[0], size), d), weight * distanceSquared({e1, e2}, d),
                  1e-10 * weight * dotOf(d, d));
      // In the plane: nothing, whatever the field is there.
      Vector inside = d;
      for (size_t i = 0; i < 3; ++i) inside[i] = 0.3 * e1[i] - 2 * e2[i];
      EXPECT_NEAR(formOf(denseOf(c.quadrics[0], size), inside), 0, 1e-12 * weight);
    }
}

TEST(QuadricOfAFace, OfNoAreaIsZero) {
  Random r(6);
  for (int n : {3, 4, 9}) {
    Corners<double> c(r, 3, n, true);
    c.points[2] = c.points[1];
    for (auto kernel :
         {quadricKernels<double>(n).addFacePlane, quadricKernels<double>(n).addFaceDistance})
      c.addWith<3>(
          [&](const double* const* x, double* const* q) { kernel(x, c.scale.data(), n, 300, q); });
    for (double v : c.quadrics[0]) EXPECT_NEAR(v, 0, 1e-6);
  }
}

// --------------------------------------------------------------------------------- edges

// Two random positive definite quadrics, of condition about `1 / floor`.
template <class S>
struct Edge {
  Edge(Random& r, size_t n, double floor, size_t rank) : scale(n), x1(n), x2(n), z(n) {
    for (auto* q : {&q1, &q2}) {
      Matrix a(n, Vector(n, 0.0));
      for (size_t k = 0; k < 2 * rank; ++k) {
        const Vector v = randomVector(r, rank);
        for (size_t i = 0; i < rank; ++i)
          for (size_t j = 0; j < rank; ++j) a[i][j] += v[i] * v[j] / static_cast<double>(rank);
      }
      for (size_t i = 0; i < rank; ++i) a[i][i] += floor;
      *q = packed<S>(a, std::fabs(uniform(r)));
    }
    for (size_t i = 0; i < n; ++i) {
      scale[i] = static_cast<S>(std::exp2(2 * uniform(r)));
      x1[i] = static_cast<S>(uniform(r));
      x2[i] = static_cast<S>(uniform(r));
    }
  }
  int n() const { return static_cast<int>(scale.size()); }
  S minimize() {
    return quadricKernels<S>(n()).minimizeEdge(q1.data(), x1.data(), q2.data(), x2.data(),
                                               scale.data(), n(), z.data());
  }
  S errorAt(const std::vector<S>& at) const {
    return quadricKernels<S>(n()).errorAt(q1.data(), x1.data(), q2.data(), x2.data(), scale.data(),
                                          n(), at.data());
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
           formOf(denseOf(q1, scale.size()), d1) + formOf(denseOf(q2, scale.size()), d2);
  }
  // (A1 + A2) z = (A2 - A1) h over the first `rank` dimensions.
  Vector denseMinimum(size_t rank) const {
    const Matrix a = denseOf(q1, scale.size()), b = denseOf(q2, scale.size());
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
  std::vector<S> q1, q2, scale, x1, x2, z;
};

template <class S>
void expectDenseMinimum(double tolerance) {
  Random r(7);
  for (int n : {3, 4, 6, 9, 20})
    for (int round = 0; round < (slowRun() ? 3 : 50); ++round) {
      Edge<S> e(r, static_cast<size_t>(n), 0.2, static_cast<size_t>(n));
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
  for (int n : {3, 4, 6, 9, 20})
    for (size_t rank = 0; rank < static_cast<size_t>(n); rank += 2)
      for (int round = 0; round < 5; ++round) {
        Edge<S> e(r, static_cast<size_t>(n), 0.2, rank);
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
  Edge<double> e(r, 3, 0, 3);
  e.q1 = packed<double>({{1, 0, 0}, {0, 1, 0}, {0, 0, 1e-6}}, 0);
  e.q2 = packed<double>({{1, 0, 0}, {0, 1, 0}, {0, 0, 1e-9}}, 0);
  e.minimize();
  EXPECT_LT(std::fabs(e.z[2]), 1e-3 * std::fabs(e.half()[2]));
}

// Both quadrics alike: the midpoint. All zero: the midpoint, at no cost.
TEST(MinimumOfAnEdge, IsTheMidpointOfEqualQuadrics) {
  Random r(10);
  for (int n : {3, 4, 9}) {
    Edge<double> e(r, static_cast<size_t>(n), 0.1, static_cast<size_t>(n));
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
TEST(MinimumOfAnEdge, DoesNotDependOnUnits) {
  Random r(11);
  for (int n : {4, 9})
    for (double unit : {0x1p20, 0x1p-20, 0x1p60}) {
      Edge<float> e(r, static_cast<size_t>(n), 0.1, static_cast<size_t>(n));
      const float error = e.minimize();
      const std::vector<float> z = e.z;
      for (size_t i = 0; i < e.scale.size(); ++i) {
        e.x1[i] *= static_cast<float>(unit);
        e.x2[i] *= static_cast<float>(unit);
        e.scale[i] /= static_cast<float>(unit);
      }
      EXPECT_EQ(e.minimize(), error);
      EXPECT_TRUE(e.z == z);
    }
}

TEST(MinimumOfAnEdge, IsNeverBelowTheErrorsItStartsFrom) {
  Random r(12);
  for (int round = 0; round < (slowRun() ? 50 : 2000); ++round) {
    const size_t n = 3 + r.below(6);
    // Not even positive semidefinite: what rounding may leave of a sum of quadrics.
    Edge<float> e(r, n, -0.05, n);
    const float error = e.minimize();
    EXPECT_FALSE(error < e.q1.back() + e.q2.back());
    EXPECT_FALSE(e.errorAt(e.z) < e.q1.back() + e.q2.back());
  }
}

TEST(MinimumOfAnEdge, IsNotFiniteWhereTheArithmeticOverflows) {
  Random r(13);
  Edge<float> e(r, 4, 0.2, 4);
  for (float& q : e.q1) q *= 1e38f;
  for (float& x : e.x1) x *= 1e19f;
  const float error = e.minimize();
  EXPECT_FALSE(std::isfinite(error));
}

// ---------------------------------------------------------------------------------- builds

template <class S>
void expectSameBits(const QuadricKernels<S>& a, const QuadricKernels<S>& b, int n, Random& r) {
  const auto bytes = [](const std::vector<S>& v) { return v.size() * sizeof(S); };
  Corners<S> cell(r, 4, n, false), other = cell, face(r, 3, n, false), other_face = face;
  const auto addAll = [n](const QuadricKernels<S>& k, Corners<S>& c, Corners<S>& f) {
    c.template addWith<4>([&](const S* const* x, S* const* q) {
      k.addCellField(x, c.scale.data(), n, q);
      k.addCellDistance(x, c.scale.data(), n, q);
    });
    f.template addWith<3>([&](const S* const* x, S* const* q) {
      k.addFacePlane(x, f.scale.data(), n, 300, q);
      k.addFaceDistance(x, f.scale.data(), n, 300, q);
    });
  };
  addAll(a, cell, face);
  addAll(b, other, other_face);
  for (size_t i = 0; i < 4; ++i)
    EXPECT_EQ(
        0, std::memcmp(cell.quadrics[i].data(), other.quadrics[i].data(), bytes(cell.quadrics[i])));
  for (size_t i = 0; i < 3; ++i)
    EXPECT_EQ(0, std::memcmp(face.quadrics[i].data(), other_face.quadrics[i].data(),
                             bytes(face.quadrics[i])));
  Edge<S> e(r, static_cast<size_t>(n), 0.01, static_cast<size_t>(n));
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
}

// quadricKernels gives the build for this processor.
TEST(QuadricKernels, GiveTheSameBitsFromEveryBuild) {
  Random r(14);
  for (int n : kDimensions)
    for (int round = 0; round < (slowRun() ? 2 : 50); ++round) {
      expectSameBits(plainKernelsFloat(n), quadricKernels<float>(n), n, r);
      expectSameBits(plainKernelsDouble(n), quadricKernels<double>(n), n, r);
    }
  RecordProperty("build", kernelBuild());
}

}  // namespace
}  // namespace tetstream::test
