// tests: dense arithmetic written out, and corners with quadrics in the kernels' form.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "kernels.h"
#include "random.h"

namespace tetstream::test {

constexpr int kDimensions[] = {3, 4, 5, 6, 7, 9, 20, 128};

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

}  // namespace tetstream::test
