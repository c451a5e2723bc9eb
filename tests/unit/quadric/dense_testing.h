// tests: dense arithmetic written out, and corners with quadrics in the kernels' form.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "kernels.h"
#include "random.h"

namespace tetstream::test {

constexpr int kDimensions[] = {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 43, 128};
constexpr QuadricLayout kLayouts[] = {QuadricLayout::kFields, QuadricLayout::kFull};
inline const char* nameOf(QuadricLayout layout) {
  return layout == QuadricLayout::kFull ? "full" : "fields";
}

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;

inline double uniform(Random& r) {
  return 2.0 * static_cast<double>(r.next() >> 11) * 0x1p-53 - 1;
}

inline Vector randomVector(Random& r, size_t n, double size = 1) {
  Vector v(n);
  for (double& x : v) x = size * uniform(r);
  return v;
}

inline double dotOf(const Vector& a, const Vector& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Gauss with pivots; the matrix is small and regular.
inline Vector solve(Matrix a, Vector b) {
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

// Of each number of A its row and column, in the order of the layout; W is in many places.
template <class Visit>
void eachEntry(QuadricLayout layout, size_t n, Visit visit) {
  const bool is_full = layout == QuadricLayout::kFull;
  size_t k = 0;
  for (size_t i = 0; i < (is_full ? n : 3); ++i)
    for (size_t j = 0; j <= i; ++j) visit(i, j, k++);
  for (size_t f = 3; f < n && !is_full; ++f)
    for (size_t j = 0; j < 3; ++j) visit(f, j, k++);
  for (size_t f = 3; f < n && !is_full; ++f) visit(f, f, k);
}

template <class S>
Matrix denseOf(QuadricLayout layout, const std::vector<S>& q, size_t n) {
  Matrix a(n, Vector(n));
  eachEntry(layout, n,
            [&](size_t i, size_t j, size_t k) { a[i][j] = a[j][i] = static_cast<double>(q[k]); });
  return a;
}

template <class S>
std::vector<S> packed(QuadricLayout layout, const Matrix& a, double error) {
  std::vector<S> q(static_cast<size_t>(quadricSize(layout, static_cast<int>(a.size()))));
  eachEntry(layout, a.size(),
            [&](size_t i, size_t j, size_t k) { q[k] = static_cast<S>(a[i][j]); });
  q.back() = static_cast<S>(error);
  return q;
}

// A random positive definite matrix of condition about 1 / floor over the first `rank` dimensions,
// as a layout can hold it: kFields has all components, or none if rank is at most 3.
inline Matrix randomForm(Random& r, QuadricLayout layout, size_t n, double floor, size_t rank) {
  Matrix a(n, Vector(n, 0.0));
  const bool is_full = layout == QuadricLayout::kFull;
  const size_t dense = is_full ? rank : rank < 3 ? rank : 3;
  for (size_t k = 0; k < 2 * dense; ++k) {
    const Vector v = randomVector(r, dense);
    for (size_t i = 0; i < dense; ++i) {
      const double part = v[i] / static_cast<double>(dense);
      double* const row = a[i].data();
      for (size_t j = 0; j <= i; ++j) row[j] += part * v[j];
    }
  }
  for (size_t i = 0; i < dense; ++i)
    for (size_t j = 0; j < i; ++j) a[j][i] = a[i][j];
  for (size_t i = 0; i < dense; ++i) a[i][i] += floor;
  if (is_full || rank <= 3) return a;
  for (int cell = 0; cell < 4; ++cell) {
    const double weight = 0.3 + 0.2 * uniform(r);
    for (size_t f = 3; f < n; ++f) {
      const Vector g = randomVector(r, 3);
      for (size_t i = 0; i < 3; ++i) {
        for (size_t j = 0; j < 3; ++j) a[i][j] += weight * g[i] * g[j] / static_cast<double>(n - 3);
        const double part = weight * g[i] / std::sqrt(static_cast<double>(n - 3));
        a[f][i] -= part;
        a[i][f] -= part;
      }
      a[f][f] += weight;
    }
  }
  for (size_t f = 3; f < n; ++f) a[f][f] += floor;
  return a;
}

// The ranks below n that randomForm can have.
inline std::vector<size_t> lowRanks(QuadricLayout layout, int n) {
  std::vector<size_t> ranks;
  for (size_t rank = 0; rank < static_cast<size_t>(n); ++rank)
    if (layout == QuadricLayout::kFull || rank <= 3) ranks.push_back(rank);
  return ranks;
}

inline double formOf(const Matrix& a, const Vector& d) {
  double sum = 0;
  for (size_t i = 0; i < d.size(); ++i) sum += d[i] * dotOf(a[i], d);
  return sum;
}

// Four (or three) points in R^n with their scales and quadrics, in the kernel's form.
template <class S>
struct Corners {
  Corners(Random& r, QuadricLayout its_layout, int count, int dimension, bool unit_scale)
      : layout(its_layout), n(dimension) {
    for (int i = 0; i < n; ++i)
      scale.push_back(static_cast<S>(unit_scale ? 1 : std::exp2(3 * uniform(r))));
    for (int k = 0; k < count; ++k) {
      std::vector<S> p;
      for (int i = 0; i < n; ++i) p.push_back(static_cast<S>(uniform(r)));
      points.push_back(p);
      quadrics.emplace_back(static_cast<size_t>(quadricSize(layout, n)), S(0));
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
  // The matrix of corner k's quadric.
  Matrix dense(size_t k) const { return denseOf(layout, quadrics[k], static_cast<size_t>(n)); }
  const QuadricKernels<S>& kernels() const { return quadricKernels<S>(layout, n); }
  QuadricLayout layout;
  int n;
  std::vector<S> scale;
  std::vector<std::vector<S>> points, quadrics;
};

}  // namespace tetstream::test
