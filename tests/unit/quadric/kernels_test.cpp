// The quadrics of cells and faces against dense arithmetic written out: the integral of the squared
// error, distances to flats.
#include "kernels.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "dense_testing.h"
#include "kernel_builds.h"
#include "test_mesh.h"

namespace tetstream::test {
namespace {

constexpr double kShape = 3e-5;  // any weight of the shape regulariser

double volumeOf(const Vector& a, const Vector& b, const Vector& c) {
  return std::fabs(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0])) /
         6;
}

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
      Corners<S> c(r, QuadricLayout::kFields, 4, n, round % 2);
      c.template addWith<4>([&](const S* const* x, S* const* q) {
        c.kernels().addCell(x, c.scale.data(), n, kShape, q);
      });
      const Vector e1 = c.edge(1), e2 = c.edge(2), e3 = c.edge(3);
      const double volume = volumeOf(e1, e2, e3);
      if (volume < 0.01 * std::pow(spaceSquared(e1) + spaceSquared(e2) + spaceSquared(e3), 1.5))
        continue;  // thin cells have a rule of their own
      const Matrix a = c.dense(2);
      const Vector d = randomVector(r, static_cast<size_t>(n));
      double wanted = kShape * volume / 4 * spaceSquared(d), size = 0;
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
    Corners<double> c(r, QuadricLayout::kFields, 4, n, true);
    c.addWith<4>([&](const double* const* x, double* const* q) {
      c.kernels().addCell(x, c.scale.data(), n, kShape, q);
    });
    const Vector e1 = c.edge(1), e2 = c.edge(2), e3 = c.edge(3);
    const Matrix a = c.dense(0);
    for (int round = 0; round < 10; ++round) {
      const double s = 3 * uniform(r), t = 3 * uniform(r), u = 3 * uniform(r);
      Vector d(static_cast<size_t>(n));
      for (size_t i = 0; i < d.size(); ++i) d[i] = s * e1[i] + t * e2[i] + u * e3[i];
      const double volume = volumeOf(e1, e2, e3);
      EXPECT_NEAR(formOf(a, d), kShape * volume / 4 * spaceSquared(d), 1e-9 * dotOf(d, d));
    }
  }
}

// A flat cell has no gradient; its quadric is bounded and no infinity gets into it.
TEST(QuadricOfACell, IsBoundedForFlatCells) {
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 7, 9}) {
      Random r(3);
      Corners<float> c(r, layout, 4, n, true);
      for (auto& p : c.points) p[2] = 0.5f;
      c.addWith<4>([&](const float* const* x, float* const* q) {
        c.kernels().addCell(x, c.scale.data(), n, kShape, q);
      });
      for (float v : c.quadrics[0]) EXPECT_LT(std::fabs(v), 1e6f) << nameOf(layout);
    }
}

// Four cells of a table's vertices, some of which they share.
template <class S>
struct FourCells {
  FourCells(Random& r, int n)
      : dimension(n), quadrics(7 * size_t(quadricSize(kLayout, n)) + 3), values(7 * size_t(n) + 3) {
    for (S& v : values) v = static_cast<S>(uniform(r));
    for (S& q : quadrics) q = static_cast<S>(uniform(r));
    for (int i = 0; i < n; ++i) scale.push_back(static_cast<S>(2 + uniform(r)));
  }
  VertexTable<S> table() const {
    return {quadrics.data(), values.data(), quadricSize(kLayout, dimension), dimension};
  }
  bool addAtOnce(const QuadricKernels<S>& k) {
    return k.addCells(table(), quadrics.data(), corners, corners, scale.data(), dimension, kShape,
                      determinants);
  }
  void addInTurn(const QuadricKernels<S>& k) {
    for (int c = 0; c < 4; ++c) {
      const S* x[4];
      S* q[4];
      for (int j = 0; j < 4; ++j) {
        x[j] = table().value(corners[4 * c + j]);
        q[j] = quadrics.data() + (table().quadric(corners[4 * c + j]) - quadrics.data());
      }
      determinants[c] = k.addCell(x, scale.data(), dimension, kShape, q);
    }
  }
  static constexpr QuadricLayout kLayout = QuadricLayout::kFields;
  int dimension;
  std::vector<S> quadrics, values, scale;
  uint32_t corners[16] = {0, 1, 2, 3, 1, 2, 3, 4, 6, 1, 4, 2, 5, 0, 3, 6};
  double determinants[4] = {};
};

template <class S>
void expectAsInTurn(const QuadricKernels<S>& kernels, int n) {
  Random r(7);
  int rounds = 0;
  for (int round = 0; round < 30; ++round) {
    FourCells<S> a(r, n), b = a;
    if (!a.addAtOnce(kernels)) continue;
    ++rounds;
    b.addInTurn(quadricKernels<S>(QuadricLayout::kFields, n));
    EXPECT_EQ(0, std::memcmp(a.quadrics.data(), b.quadrics.data(), a.quadrics.size() * sizeof(S)));
    for (int c = 0; c < 4; ++c) EXPECT_EQ(a.determinants[c], b.determinants[c]);
  }
  EXPECT_GT(rounds, 20) << "n = " << n;
}
TEST(QuadricsOfFourCells, AreThoseOfEachInTurn) {
  constexpr QuadricLayout layout = QuadricLayout::kFields;
  for (int n : kDimensions) {
    expectAsInTurn(quadricKernels<float>(layout, n), n);
    expectAsInTurn(quadricKernels<double>(layout, n), n);
    expectAsInTurn(plainKernelsFloat(layout, n), n);
    expectAsInTurn(plainKernelsDouble(layout, n), n);
  }
}

TEST(QuadricsOfFourCells, AreLeftWhereOneCellIsFlat) {
  Random r(8);
  for (int n : {3, 4, 7, 9, 40}) {
    FourCells<float> cells(r, n);
    for (int v : {1, 2, 3, 4}) cells.values[size_t(v * n + 2)] = 0.25f;
    const std::vector<float> before = cells.quadrics;
    EXPECT_FALSE(cells.addAtOnce(quadricKernels<float>(QuadricLayout::kFields, n)));
    EXPECT_TRUE(cells.quadrics == before);
  }
  FourCells<float> sound(r, 4);
  EXPECT_FALSE(sound.addAtOnce(quadricKernels<float>(QuadricLayout::kFull, 4)));
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
      Corners<double> c(r, QuadricLayout::kFull, 4, n, round % 2);
      c.addWith<4>([&](const double* const* x, double* const* q) {
        c.kernels().addCell(x, c.scale.data(), n, kShape, q);
      });
      const Vector e1 = c.edge(1), e2 = c.edge(2), e3 = c.edge(3);
      const double volume = volumeOf(e1, e2, e3);
      if (volume < 0.01 * std::pow(spaceSquared(e1) + spaceSquared(e2) + spaceSquared(e3), 1.5))
        continue;
      const Vector d = randomVector(r, static_cast<size_t>(n));
      const double wanted =
          volume / 4 * (distanceSquared({e1, e2, e3}, d)) + kShape * volume / 4 * spaceSquared(d);
      EXPECT_NEAR(formOf(c.dense(1), d), wanted, 1e-10 * volume * dotOf(d, d)) << "n = " << n;
    }
}

// Three corners together have weight * area times the squared distance.
TEST(QuadricOfAFace, IsTheDistanceToItsPlaneOrFlat) {
  Random r(5);
  for (int n : kDimensions)
    for (int round = 0; round < (slowRun() ? 1 : 10); ++round) {
      Corners<double> c(r, QuadricLayout::kFields, 3, n, round % 2);
      Corners<double> flat(r, QuadricLayout::kFull, 3, n, true);
      flat.points = c.points;
      flat.scale = c.scale;
      const auto size = static_cast<size_t>(n);
      c.addWith<3>([&](const double* const* x, double* const* q) {
        c.kernels().addFace(x, c.scale.data(), n, 7, 0, q);
      });
      flat.addWith<3>([&](const double* const* x, double* const* q) {
        flat.kernels().addFace(x, c.scale.data(), n, 7, 0, q);
      });
      const Vector e1 = c.edge(1), e2 = c.edge(2);
      const Vector s1(e1.begin(), e1.begin() + 3), s2(e2.begin(), e2.begin() + 3);
      const double area =
          0.5 * std::sqrt(dotOf(s1, s1) * dotOf(s2, s2) - std::pow(dotOf(s1, s2), 2));
      const Vector d = randomVector(r, size);
      const Vector in_space(d.begin(), d.begin() + 3);
      const double weight = 7 * area / 3;
      EXPECT_NEAR(formOf(c.dense(0), d), weight * distanceSquared({s1, s2}, in_space),
                  1e-10 * weight * dotOf(d, d));
      EXPECT_NEAR(formOf(flat.dense(0), d), weight * distanceSquared({e1, e2}, d),
                  1e-10 * weight * dotOf(d, d));
      // In the plane: nothing, whatever the field is there.
      Vector inside = d;
      for (size_t i = 0; i < 3; ++i) inside[i] = 0.3 * e1[i] - 2 * e2[i];
      EXPECT_NEAR(formOf(c.dense(0), inside), 0, 1e-12 * weight);
    }
}

// Where the field has a slope across the boundary a vertex has, for its share of the cells, the
// square of what a step off the boundary changes it by, in each component.
TEST(QuadricOfAFace, CountsTheFieldBeyondIt) {
  Random r(16);
  for (int n : {3, 4, 7, 12}) {
    Corners<double> c(r, QuadricLayout::kFields, 4, n, n % 2);
    std::vector<Vector> slopes;
    for (int f = 3; f < n; ++f) {
      slopes.push_back(randomVector(r, 3));
      for (std::vector<double>& p : c.points) {  // linear, in normalised units
        double value = 0;
        for (size_t i = 0; i < 3; ++i) value += slopes.back()[i] * p[i] * c.scale[i];
        p[static_cast<size_t>(f)] = value / c.scale[static_cast<size_t>(f)];
      }
    }
    c.addWith<4>([&](const double* const* x, double* const* q) {
      c.kernels().addCell(x, c.scale.data(), n, kShape, q);
    });
    const Vector d = randomVector(r, static_cast<size_t>(n));
    const double before = formOf(c.dense(1), d);
    c.addWith<3>([&](const double* const* x, double* const* q) {
      c.kernels().addFace(x, c.scale.data(), n, 0, 2, q);
    });
    Vector normal(3);
    const Vector e1 = c.edge(1), e2 = c.edge(2);
    for (size_t i = 0; i < 3; ++i)
      normal[i] = e1[(i + 1) % 3] * e2[(i + 2) % 3] - e1[(i + 2) % 3] * e2[(i + 1) % 3];
    const double size = std::sqrt(dotOf(normal, normal)),
                 off = dotOf(normal, {d[0], d[1], d[2]}) / size;
    double squares = 0;
    for (const Vector& slope : slopes) squares += std::pow(dotOf(slope, normal) / size * off, 2);
    const double share = volumeOf(e1, e2, c.edge(3)) / 4;
    EXPECT_NEAR(formOf(c.dense(1), d) - before, 2 * share * squares / 3, 1e-9 * (before + squares))
        << "n = " << n;
  }
}

TEST(QuadricOfAFace, OfNoAreaIsZero) {
  Random r(6);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 9}) {
      Corners<double> c(r, layout, 3, n, true);
      c.points[2] = c.points[1];
      c.addWith<3>([&](const double* const* x, double* const* q) {
        c.kernels().addFace(x, c.scale.data(), n, 300, 1, q);
      });
      for (double v : c.quadrics[0]) EXPECT_NEAR(v, 0, 1e-6) << nameOf(layout);
    }
}

// In units in which each component is divided by its factor, the form is `weight` times what it
// was: d / factor stands for d.
TEST(RescaledQuadric, IsTheSameFormInOtherUnits) {
  Random r(9);
  for (QuadricLayout layout : kLayouts)
    for (int n : {3, 4, 7, 12, 40}) {
      const auto size = static_cast<size_t>(n);
      auto q = packed<double>(layout, randomForm(r, layout, size, 0.1, size), 0.7);
      const Matrix before = denseOf(layout, q, size);
      std::vector<double> factor(size, std::exp2(uniform(r)));
      for (size_t i = 0; i < size; ++i)
        if (layout == QuadricLayout::kFull) factor[i] = std::exp2(uniform(r));
      quadricKernels<double>(layout, n).rescale(factor.data(), 3, n, q.data());
      EXPECT_DOUBLE_EQ(q.back(), 3 * 0.7);
      for (int k = 0; k < 5; ++k) {
        const Vector d = randomVector(r, size);
        Vector there = d;
        for (size_t i = 0; i < size; ++i) there[i] /= factor[i];
        EXPECT_NEAR(formOf(denseOf(layout, q, size), there), 3 * formOf(before, d),
                    1e-12 * dotOf(d, d) * static_cast<double>(n));
      }
    }
}

// Where the components grow differently, of one cell the quadric is that of the cell in the new
// units; of several it keeps what W weighs, is not less than the sum, and not indefinite.
TEST(RescaledQuadric, OfUnequalFieldsIsThatOfTheirCell) {
  Random r(10);
  for (int cells = 1; cells <= 2; ++cells)
    for (int n : {5, 6, 9, 20}) {
      constexpr QuadricLayout layout = QuadricLayout::kFields;
      Corners<double> before(r, layout, 4, n, true), after = before;
      const auto size = static_cast<size_t>(n);
      std::vector<double> factor(size, 1.0);
      for (size_t f = 3; f < size; ++f) factor[f] = std::exp2(1 + uniform(r));
      for (size_t f = 3; f < size; ++f) after.scale[f] = before.scale[f] / factor[f];
      for (int cell = 0; cell < cells; ++cell) {
        for (Corners<double>* c : {&before, &after}) {
          if (cell > 0) c->points[1] = {0.3, -0.2, 2.0}, c->points[1].resize(size, 0.5);
          c->addWith<4>([&](const double* const* x, double* const* q) {
            c->kernels().addCell(x, c->scale.data(), n, 0, q);
          });
        }
      }
      const double least = *std::min_element(factor.begin() + 3, factor.end());
      before.kernels().rescale(factor.data(), 1 / (least * least), n, before.quadrics[0].data());
      const Matrix got = before.dense(0);
      Matrix wanted = after.dense(0);
      for (size_t i = 3; i < size; ++i) {
        EXPECT_NEAR(got[i][i], wanted[i][i], 1e-12 * wanted[i][i]);
        // G is in both; its space is not that of the old weight where weight / least^2 differ.
        for (size_t j = 0; j < 3; ++j)
          EXPECT_NEAR(got[i][j], wanted[i][j], 1e-11 * std::sqrt(got[i][i] * got[j][j]) + 1e-14);
      }
      for (int k = 0; k < 20; ++k) {
        const Vector d = randomVector(r, size);
        const double form = formOf(got, d), least_form = formOf(wanted, d);
        const double rounding = 1e-10 * (form + dotOf(d, d) * got[3][3]);
        if (cells == 1)
          EXPECT_NEAR(form, least_form, rounding) << "n = " << n;
        else
          EXPECT_GE(form, least_form - rounding) << "n = " << n;
      }
    }
}

}  // namespace
}  // namespace tetstream::test
