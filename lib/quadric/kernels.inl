// quadric: the bodies of the kernels. Compiled once per instruction set by kernels_*.cpp, each in
// an anonymous namespace, so that no function of one build is ever linked into another. For the
// same reason nothing here calls the standard library. Sums run in a fixed order and nothing is
// contracted: all builds give the same numbers.
#include "kernels.h"

namespace tetstream {
namespace {

inline double squareRoot(double v) {
  return __builtin_sqrt(v);
}

inline int at(int i, int j) {
  return i * (i + 1) / 2 + j;
}  // j <= i

// The dimension: known to the compiler where N > 0.
template <int N>
inline int dimension(int n) {
  return N > 0 ? N : n;
}

template <int N>
constexpr int kRoom = N > 0 ? N : kMaxDimension;

// b - a in normalised units.
template <class S>
inline void difference(const S* a, const S* b, const S* scale, int n, double* out) {
  for (int i = 0; i < n; ++i)
    out[i] = static_cast<double>(b[i] - a[i]) * static_cast<double>(scale[i]);
}

inline void cross(const double* a, const double* b, double* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

inline double dot(const double* a, const double* b, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

// 6 V, raised for near-flat cells.
inline double effectiveVolume(const double* e1, const double* e2, const double* e3, double det) {
  const double size = dot(e1, e1, 3) + dot(e2, e2, 3) + dot(e3, e3, 3);
  const double least = kFlatVolume * size * squareRoot(size);
  const double volume = det < 0 ? -det : det;
  return volume > least ? volume : least;
}

template <class S>
inline void addToAll(const double* a, int size, S* const* q, int count) {
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < size; ++i) q[k][i] += static_cast<S>(a[i]);
}

template <class S, int N>
void addCellField(const S* const x[4], const S* scale, int n_given, S* const q[4]) {
  const int n = dimension<N>(n_given), size = n * (n + 1) / 2;
  double e1[kRoom<N>], e2[kRoom<N>], e3[kRoom<N>], a[kRoom<N> * (kRoom<N> + 1) / 2];
  difference(x[0], x[1], scale, n, e1);
  difference(x[0], x[2], scale, n, e2);
  difference(x[0], x[3], scale, n, e3);
  double c1[3], c2[3], c3[3];
  cross(e2, e3, c1);
  cross(e3, e1, c2);
  cross(e1, e2, c3);
  const double det = dot(e1, c1, 3);
  const double volume = effectiveVolume(e1, e2, e3, det);
  const double w = 1.0 / (24.0 * volume);  // a quarter of 1 / (6 * 6V) times n n^T
  for (int i = 0; i < size; ++i) a[i] = 0;
  for (int f = 3; f < n; ++f) {
    double g[3];  // det times the gradient of component f
    for (int i = 0; i < 3; ++i) g[i] = e1[f] * c1[i] + e2[f] * c2[i] + e3[f] * c3[i];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j <= i; ++j) a[at(i, j)] += w * (g[i] * g[j]);
      a[at(f, i)] = -(w * (g[i] * det));
    }
    a[at(f, f)] = w * (det * det);
  }
  for (int i = 0; i < 3; ++i) a[at(i, i)] += kShapeWeight * volume / 24.0;
  addToAll(a, size, q, 4);
}

// a = weight (I - sum of the projections on the span of `count` edges).
template <int Room>
inline void distanceForm(double (*edges)[Room], int count, int n, double weight, double* a) {
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) a[at(i, j)] = i == j ? weight : 0;
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
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) a[at(i, j)] -= weight * (e[i] * e[j]);
  }
}

template <class S, int N>
void addCellDistance(const S* const x[4], const S* scale, int n_given, S* const q[4]) {
  const int n = dimension<N>(n_given), size = n * (n + 1) / 2;
  double e[3][kRoom<N>], a[kRoom<N> * (kRoom<N> + 1) / 2];
  for (int k = 0; k < 3; ++k) difference(x[0], x[k + 1], scale, n, e[k]);
  double c[3];
  cross(e[1], e[2], c);
  const double det = dot(e[0], c, 3);
  const double volume = effectiveVolume(e[0], e[1], e[2], det);
  distanceForm<kRoom<N>>(e, 3, n, volume / 24.0, a);
  for (int i = 0; i < 3; ++i) a[at(i, i)] += kShapeWeight * volume / 24.0;
  addToAll(a, size, q, 4);
}

template <class S, int N>
void addFacePlane(const S* const x[3], const S* scale, int n_given, double weight, S* const q[3]) {
  (void)n_given;  // the plane is in space: the first six numbers of the triangle
  double e1[3], e2[3], c[3], a[6];
  difference(x[0], x[1], scale, 3, e1);
  difference(x[0], x[2], scale, 3, e2);
  cross(e1, e2, c);
  const double c2 = dot(c, c, 3);
  if (!(c2 > 0)) return;
  const double area = 0.5 * squareRoot(c2);
  const double w = weight * (area * squareRoot(area)) / 3.0 / c2;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) a[at(i, j)] = w * (c[i] * c[j]);
  addToAll(a, 6, q, 3);
}

template <class S, int N>
void addFaceDistance(const S* const x[3], const S* scale, int n_given, double weight,
                     S* const q[3]) {
  const int n = dimension<N>(n_given), size = n * (n + 1) / 2;
  double e[2][kRoom<N>], c[3], a[kRoom<N> * (kRoom<N> + 1) / 2];
  difference(x[0], x[1], scale, n, e[0]);
  difference(x[0], x[2], scale, n, e[1]);
  cross(e[0], e[1], c);
  const double area = 0.5 * squareRoot(dot(c, c, 3));
  distanceForm<kRoom<N>>(e, 2, n, weight * (area * squareRoot(area)) / 3.0, a);
  addToAll(a, size, q, 3);
}

// d^T A d for a packed A.
template <class S>
inline S quadraticForm(const S* a, const S* d, int n) {
  S sum = 0;
  for (int i = 0; i < n; ++i) {
    S row = 0;
    for (int j = 0; j < i; ++j) row += a[at(i, j)] * d[j];
    sum += d[i] * (2 * row + a[at(i, i)] * d[i]);
  }
  return sum;
}

// h = half of scale (x2 - x1); returns the error at z.
template <class S, int N>
inline S errorFrom(const S* q1, const S* q2, const S* h, int n, const S* z) {
  S d1[kRoom<N>], d2[kRoom<N>];
  for (int i = 0; i < n; ++i) {
    d1[i] = z[i] + h[i];
    d2[i] = z[i] - h[i];
  }
  const int size = n * (n + 1) / 2;
  const S rise1 = quadraticForm(q1, d1, n), rise2 = quadraticForm(q2, d2, n);
  // A is positive semidefinite up to rounding: the error never falls below e1 + e2. A comparison
  // written this way lets a NaN through to the caller.
  return q1[size] + q2[size] + (rise1 < 0 ? 0 : rise1) + (rise2 < 0 ? 0 : rise2);
}

template <class S>
inline void halfEdge(const S* x1, const S* x2, const S* scale, int n, S* h) {
  for (int i = 0; i < n; ++i) h[i] = S(0.5) * ((x2[i] - x1[i]) * scale[i]);
}

template <class S, int N>
S errorAt(const S* q1, const S* x1, const S* q2, const S* x2, const S* scale, int n_given,
          const S* z) {
  const int n = dimension<N>(n_given);
  S h[kRoom<N>];
  halfEdge(x1, x2, scale, n, h);
  return errorFrom<S, N>(q1, q2, h, n, z);
}

// Fig. 5 of the paper. At the midpoint the residual is A1 p1 + A2 p2 - (A1 + A2) m =
// (A1 - A2)(p1 - p2) / 2, free of cancellation. s t is the Rayleigh quotient along the direction;
// a small one means that the minimum is not determined there, and z stays at the midpoint in it.
template <class S, int N>
S minimizeEdge(const S* q1, const S* x1, const S* q2, const S* x2, const S* scale, int n_given,
               S* z) {
  const int n = dimension<N>(n_given);
  S h[kRoom<N>], r[kRoom<N>], d[kRoom<N>], q[kRoom<N>], a[kRoom<N> * (kRoom<N> + 1) / 2];
  halfEdge(x1, x2, scale, n, h);
  S trace = 0;
  for (int i = 0; i < n; ++i) r[i] = d[i] = z[i] = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      const int k = at(i, j);
      a[k] = q1[k] + q2[k];
      const S b = q2[k] - q1[k];
      r[i] += b * h[j];
      if (j < i) r[j] += b * h[i];
    }
    trace += a[at(i, i)];
  }
  const S limit = trace / S(n * kMaxCondition);
  for (int step = 0; step < n; ++step) {
    S s = 0, t = 0;
    for (int i = 0; i < n; ++i) s += r[i] * r[i];
    if (!(s > 0)) break;
    for (int i = 0; i < n; ++i) d[i] += r[i] / s;
    for (int i = 0; i < n; ++i) q[i] = 0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < i; ++j) {
        q[i] += a[at(i, j)] * d[j];
        q[j] += a[at(i, j)] * d[i];
      }
      q[i] += a[at(i, i)] * d[i];
    }
    for (int i = 0; i < n; ++i) t += d[i] * q[i];
    if (!(s * t > limit)) break;
    for (int i = 0; i < n; ++i) {
      r[i] -= q[i] / t;
      z[i] += d[i] / t;
    }
  }
  return errorFrom<S, N>(q1, q2, h, n, z);
}

template <class S, int N>
constexpr QuadricKernels<S> kKernels = {addCellField<S, N>, addCellDistance<S, N>,
                                        addFacePlane<S, N>, addFaceDistance<S, N>,
                                        minimizeEdge<S, N>, errorAt<S, N>};

template <class S>
const QuadricKernels<S>& kernelsFor(int n) {
  switch (n) {
    case 3:
      return kKernels<S, 3>;
    case 4:
      return kKernels<S, 4>;
    case 5:
      return kKernels<S, 5>;
    case 6:
      return kKernels<S, 6>;
    case 7:
      return kKernels<S, 7>;
    default:
      return kKernels<S, 0>;
  }
}

}  // namespace
}  // namespace tetstream
