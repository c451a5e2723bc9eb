// quadric: distances to cells and faces in R^n, in the layout kFull. Part of kernels.inl.
#include "cells.inl"

namespace tetstream {
namespace {

// Makes the edges orthonormal.
template <int Room>
inline void orthonormalise(double (*edges)[Room], int count, int n) {
  for (int k = 0; k < count; ++k) {
    double* e = edges[k];
    const double before = dot(e, e, n);
    for (int b = 0; b < k; ++b) {
      const double along = dot(e, edges[b], n);
      for (int i = 0; i < n; ++i) e[i] -= along * edges[b][i];
    }
    const double length2 = dot(e, e, n);
    const double inverse = length2 > 1e-24 * before ? 1.0 / squareRoot(length2) : 0.0;
    for (int i = 0; i < n; ++i) e[i] *= inverse;  // dependent edges span nothing new
  }
}

// Adds weight (I - sum of the projections on the span of `count` edges), and in space `shape` times
// I, to each of `corners` quadrics, entry by entry: a large form would need a large stack.
template <class S, int Room>
inline void addDistanceForm(double (*edges)[Room], int count, int n, double weight, double shape,
                            S* const* q, int corners) {
  orthonormalise(edges, count, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) {
      double a = i == j ? weight : 0;
      for (int k = 0; k < count; ++k) a -= weight * (edges[k][i] * edges[k][j]);
      if (i == j && i < 3) a += shape;
      for (int k = 0; k < corners; ++k) q[k][at(i, j)] += static_cast<S>(a);
    }
}

template <class S, int N>
double addCellDistance(const S* const x[4], const S* scale, int n_given, double shape,
                       S* const q[4]) {
  const int n = dimension<N>(n_given);
  double e[3][kRoom<N>];
  for (int k = 0; k < 3; ++k) difference(x[0], x[k + 1], scale, n, e[k]);
  double c[3];
  cross(e[1], e[2], c);
  const double det = dot(e[0], c, 3);
  const double volume = effectiveVolume(e[0], e[1], e[2], det);
  addDistanceForm<S, kRoom<N>>(e, 3, n, volume / 24.0, shape * volume / 24.0, q, 4);
  return det;
}

template <class S, int N>
void addFaceDistance(const S* const x[3], const S* scale, int n_given, double weight, double,
                     S* const q[3]) {
  const int n = dimension<N>(n_given);
  double e[2][kRoom<N>], c[3];
  difference(x[0], x[1], scale, n, e[0]);
  difference(x[0], x[2], scale, n, e[1]);
  cross(e[0], e[1], c);
  const double area = 0.5 * squareRoot(dot(c, c, 3));
  addDistanceForm<S, kRoom<N>>(e, 2, n, weight * area / 3.0, 0.0, q, 3);
}

// Distances are added cell by cell.
template <class S>
bool addNoCells(const VertexTable<S>&, S*, const uint32_t*, const uint32_t*, const S*, int, double,
                double*) {
  return false;
}

}  // namespace
}  // namespace tetstream
