// tests: an edge between two vertices with random quadrics, and a table of many vertices.
#pragma once

#include <cmath>
#include <vector>

#include "dense_testing.h"

namespace tetstream::test {

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

}  // namespace tetstream::test
