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

template <class V>
inline void cross(const V* a, const V* b, V* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

template <class V>
inline V dot(const V* a, const V* b, int n) {
  V sum = V{};
  for (int i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

template <class V>
inline V squaredSize(const V* e1, const V* e2, const V* e3) {
  return dot(e1, e1, 3) + dot(e2, e2, 3) + dot(e3, e3, 3);
}

// 6 V, raised for near-flat cells.
inline double effectiveVolume(const double* e1, const double* e2, const double* e3, double det) {
  const double size = squaredSize(e1, e2, e3);
  const double least = kFlatVolume * size * squareRoot(size);
  const double volume = det < 0 ? -det : det;
  return volume > least ? volume : least;
}

template <class S>
inline void addToAll(const double* a, int size, S* const* q, int count) {
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < size; ++i) q[k][i] += static_cast<S>(a[i]);
}

// A cell (V is double) or four (V is a vector): the same operations in the same order.
template <class V, int N>
struct CellField {
  V e1[kRoom<N>], e2[kRoom<N>], e3[kRoom<N>];  // the edges from the first corner
  V c1[3], c2[3], c3[3];
  V a[kRoom<N> * (kRoom<N> + 1) / 2];

  V determinant() {
    cross(e2, e3, c1);
    cross(e3, e1, c2);
    cross(e1, e2, c3);
    return dot(e1, c1, 3);
  }
  // `volume`: the effective one.
  void form(int n, double shape, V det, V volume) {
    const V w = 1.0 / (24.0 * volume);  // a quarter of 1 / (6 * 6V) times n n^T
    for (int i = 0; i < n * (n + 1) / 2; ++i) a[i] = V{};
    for (int f = 3; f < n; ++f) {
      V g[3];  // det times the gradient of component f
      for (int i = 0; i < 3; ++i) g[i] = e1[f] * c1[i] + e2[f] * c2[i] + e3[f] * c3[i];
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) a[at(i, j)] += w * (g[i] * g[j]);
        a[at(f, i)] = -(w * (g[i] * det));
      }
      a[at(f, f)] = w * (det * det);
    }
    for (int i = 0; i < 3; ++i) a[at(i, i)] += shape * volume / 24.0;
  }
};

template <class S, int N>
double addCellField(const S* const x[4], const S* scale, int n_given, double shape, S* const q[4]) {
  const int n = dimension<N>(n_given);
  CellField<double, N> cell;
  difference(x[0], x[1], scale, n, cell.e1);
  difference(x[0], x[2], scale, n, cell.e2);
  difference(x[0], x[3], scale, n, cell.e3);
  const double det = cell.determinant();
  cell.form(n, shape, det, effectiveVolume(cell.e1, cell.e2, cell.e3, det));
  addToAll(cell.a, n * (n + 1) / 2, q, 4);
  return det;
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
double addCellDistance(const S* const x[4], const S* scale, int n_given, double shape,
                       S* const q[4]) {
  const int n = dimension<N>(n_given), size = n * (n + 1) / 2;
  double e[3][kRoom<N>], a[kRoom<N> * (kRoom<N> + 1) / 2];
  for (int k = 0; k < 3; ++k) difference(x[0], x[k + 1], scale, n, e[k]);
  double c[3];
  cross(e[1], e[2], c);
  const double det = dot(e[0], c, 3);
  const double volume = effectiveVolume(e[0], e[1], e[2], det);
  distanceForm<kRoom<N>>(e, 3, n, volume / 24.0, a);
  for (int i = 0; i < 3; ++i) a[at(i, i)] += shape * volume / 24.0;
  addToAll(a, size, q, 4);
  return det;
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
  const double w = weight * area / 3.0 / c2;
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
  distanceForm<kRoom<N>>(e, 2, n, weight * area / 3.0, a);
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

// ------------------------------------------------------------------ lanes
typedef float Float8 __attribute__((vector_size(32)));
typedef float Float4 __attribute__((vector_size(16)));
typedef double Double8 __attribute__((vector_size(64)));
typedef double Double4 __attribute__((vector_size(32)));

template <class S>
struct Lanes;
template <>
struct Lanes<float> {
  using Eight = Float8;
  using Four = Float4;
};
template <>
struct Lanes<double> {
  using Eight = Double8;
  using Four = Double4;
};
// rows[k][at .. at + 4) of eight rows, as four columns.
template <class S>
inline void loadColumns(const S* const rows[8], int first, typename Lanes<S>::Eight* columns) {
  typename Lanes<S>::Four r[8];
  typename Lanes<S>::Eight a[4];
  for (int k = 0; k < 8; ++k) __builtin_memcpy(&r[k], rows[k] + first, sizeof r[k]);
  for (int k = 0; k < 4; ++k)
    a[k] = __builtin_shufflevector(r[k], r[k + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  const auto low01 = __builtin_shufflevector(a[0], a[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const auto high01 = __builtin_shufflevector(a[0], a[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const auto low23 = __builtin_shufflevector(a[2], a[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const auto high23 = __builtin_shufflevector(a[2], a[3], 2, 10, 3, 11, 6, 14, 7, 15);
  columns[0] = __builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
  columns[1] = __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
  columns[2] = __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
  columns[3] = __builtin_shufflevector(high01, high23, 2, 3, 10, 11, 6, 7, 14, 15);
}

// ----------------------------------------------------------------- four cells side by side
static_assert(kCellLanes == 4);
// Above it neither the effective volume nor, for edges rounded to float32, the sign is in doubt.
constexpr double kSureVolume = kFlatVolume * (1 + 1e-6);

template <class T>
inline void transpose(T* r) {
  const T low01 = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5);
  const T high01 = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7);
  const T low23 = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5);
  const T high23 = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
  r[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  r[1] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  r[2] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  r[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

// The values of corner j of four cells, as columns.
template <class S, int N>
inline void loadCorner(const VertexTable<S>& table, const uint32_t* corners, int j,
                       typename Lanes<S>::Four* columns) {
  for (int first = 0; first < N; first += 4) {
    for (int k = 0; k < 4; ++k)
      __builtin_memcpy(&columns[first + k], table.value(corners[4 * k + j]) + first,
                       sizeof columns[0]);
    transpose(columns + first);
  }
}

// One cell after the other, as it would be alone: they share vertices.
template <class S, int N>
inline void addToCorners(const Double4* a, const VertexTable<S>& table, const uint32_t* corners,
                         S* quadrics) {
  using Four = typename Lanes<S>::Four;
  constexpr int kSize = N * (N + 1) / 2, kFours = (kSize + 3) / 4, kWhole = kSize / 4;
  Four rows[kFours][4];
  for (int b = 0; b < kFours; ++b) {
    for (int k = 0; k < 4; ++k)
      rows[b][k] = 4 * b + k < kSize ? __builtin_convertvector(a[4 * b + k], Four) : Four{};
    transpose(rows[b]);
  }
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      S* q = quadrics + (table.quadric(corners[4 * k + j]) - table.quadrics);
      for (int b = 0; b < kWhole; ++b) {
        Four sum;
        __builtin_memcpy(&sum, q + 4 * b, sizeof sum);
        sum += rows[b][k];
        __builtin_memcpy(q + 4 * b, &sum, sizeof sum);
      }
      for (int i = 4 * kWhole; i < kSize; ++i) q[i] += rows[kWhole][k][i % 4];
    }
}

template <class S, int N>
bool addCellFields(const VertexTable<S>& table, S* quadrics, const uint32_t* corners,
                   const S* scale, double shape, double* determinants) {
  if constexpr (N == 0) {
    return false;  // four large ones would need a large stack
  } else {
    using Four = typename Lanes<S>::Four;
    constexpr int kRows = (N + 3) / 4 * 4;
    CellField<Double4, N> cells;
    Four origin[kRows], end[kRows];
    loadCorner<S, N>(table, corners, 0, origin);
    Double4* const edges[3] = {cells.e1, cells.e2, cells.e3};
    for (int j = 0; j < 3; ++j) {
      loadCorner<S, N>(table, corners, j + 1, end);
      for (int i = 0; i < N; ++i)
        edges[j][i] =
            __builtin_convertvector(end[i] - origin[i], Double4) * static_cast<double>(scale[i]);
    }
    const Double4 det = cells.determinant();
    const Double4 size = squaredSize(cells.e1, cells.e2, cells.e3);
    const auto sure = det * det > kSureVolume * kSureVolume * (size * size * size);
    if (!(sure[0] & sure[1] & sure[2] & sure[3])) return false;
    cells.form(N, shape, det, det < 0 ? -det : det);
    addToCorners<S, N>(cells.a, table, corners, quadrics);
    for (int k = 0; k < 4; ++k) determinants[k] = det[k];
    return true;
  }
}

// ------------------------------------------------------------------ many edges side by side
static_assert(kEdgeLanes == 8);

// The direct solve, for one edge (V is S) or eight (V is a vector of S): the same operations in the
// same order.
template <class S, class V, int N>
struct EdgeSolver {
  static constexpr int kSize = (kRoom<N> * (kRoom<N> + 1) / 2 + 1 + 3) / 4 * 4;
  V a1[kSize], a2[kSize];                    // the quadrics: A, then e
  V h[(kRoom<N> + 3) / 4 * 4], z[kRoom<N>];  // half the edge, the minimizer

  // (A1 + A2) z = (A2 - A1) h, the condition of a minimum written from the midpoint. The last
  // variables go first. What is left in space may be rounding alone, of the size of what was
  // there before: the ridge is measured by that.
  void solve(int n) {
    V r[kRoom<N>], m[kSize], inverse[kRoom<N>], ridge = V{};
    for (int i = 0; i < n; ++i) r[i] = V{};
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        m[at(i, j)] = a1[at(i, j)] + a2[at(i, j)];
        const V b = a2[at(i, j)] - a1[at(i, j)];
        r[i] += b * h[j];
        if (j < i) r[j] += b * h[i];
        if (j == i && i < 3) ridge += m[at(i, j)];
      }
    for (int p = n - 1; p >= 0; --p) {
      const V pivot = p < 3 ? m[at(p, p)] + S(kSolveWeight) * ridge : m[at(p, p)];
      inverse[p] = S(1) / (pivot + S(1e-30));  // never 1 / 0
      for (int i = 0; i < p; ++i) {
        const V factor = m[at(p, i)] * inverse[p];
        for (int j = 0; j <= i; ++j) m[at(i, j)] -= factor * m[at(p, j)];
        r[i] -= factor * r[p];
      }
    }
    for (int p = 0; p < n; ++p) {
      for (int i = 0; i < p; ++i) r[p] -= m[at(p, i)] * z[i];
      z[p] = r[p] * inverse[p];
    }
  }

  // As errorFrom.
  void measure(int n, V* error) const {
    const V none = V{};
    V rise1 = none, rise2 = none;
    for (int i = 0; i < n; ++i) {
      V row1 = none, row2 = none;
      for (int j = 0; j < i; ++j) {
        row1 += a1[at(i, j)] * (z[j] + h[j]);
        row2 += a2[at(i, j)] * (z[j] - h[j]);
      }
      const V d1 = z[i] + h[i], d2 = z[i] - h[i];
      rise1 += d1 * (S(2) * row1 + a1[at(i, i)] * d1);
      rise2 += d2 * (S(2) * row2 + a2[at(i, i)] * d2);
    }
    const int e = n * (n + 1) / 2;
    *error = a1[e] + a2[e] + (rise1 < none ? none : rise1) + (rise2 < none ? none : rise2);
  }
};

template <class S, int N>
S solveEdge(const S* q1, const S* x1, const S* q2, const S* x2, const S* scale, int n_given, S* z) {
  const int n = dimension<N>(n_given);
  EdgeSolver<S, S, N> edge;
  for (int i = 0; i <= n * (n + 1) / 2; ++i) {
    edge.a1[i] = q1[i];
    edge.a2[i] = q2[i];
  }
  for (int i = 0; i < n; ++i) edge.h[i] = S(0.5) * ((x2[i] - x1[i]) * scale[i]);
  edge.solve(n);
  S error;
  edge.measure(n, &error);
  for (int i = 0; i < n; ++i) z[i] = edge.z[i];
  return error;
}

template <class S, int N>
inline void edgeErrorsByEight(const VertexTable<S>& table, uint32_t u, const uint32_t* others,
                              int count, const S* scale, S* errors) {
  using V = typename Lanes<S>::Eight;
  constexpr int kSize = N * (N + 1) / 2 + 1;
  const S *qu = table.quadric(u), *xu = table.value(u);
  EdgeSolver<S, V, N> edges;
  for (int i = 0; i < kSize; ++i) edges.a1[i] = V{} + qu[i];
  for (int first = 0; first < count; first += 8) {
    const int filled = count - first < 8 ? count - first : 8;
    const S *q[8], *x[8];
    for (int k = 0; k < 8; ++k) {  // the lanes left over repeat the last edge
      const uint32_t v = others[first + (k < filled ? k : filled - 1)];
      q[k] = table.quadric(v);
      x[k] = table.value(v);
    }
    for (int i = 0; i < kSize; i += 4) loadColumns(q, i, edges.a2 + i);
    for (int i = 0; i < N; i += 4) loadColumns(x, i, edges.h + i);
    for (int i = 0; i < N; ++i) edges.h[i] = S(0.5) * ((edges.h[i] - xu[i]) * scale[i]);
    edges.solve(N);
    V error;
    edges.measure(N, &error);
    for (int k = 0; k < filled; ++k) errors[first + k] = error[k];
  }
}

template <class S, int N>
void edgeErrors(const VertexTable<S>& table, uint32_t u, const uint32_t* others, int count,
                const S* scale, int n_given, S* errors) {
  if constexpr (N == 0) {  // eight large ones would need a large stack
    S z[kMaxDimension];
    for (int i = 0; i < count; ++i)
      errors[i] = solveEdge<S, N>(table.quadric(u), table.value(u), table.quadric(others[i]),
                                  table.value(others[i]), scale, n_given, z);
  } else {
    edgeErrorsByEight<S, N>(table, u, others, count, scale, errors);
  }
}

template <class S, int N>
constexpr QuadricKernels<S> kKernels = {
    addCellField<S, N>, addCellFields<S, N>,   addCellDistance<S, N>,
    addFacePlane<S, N>, addFaceDistance<S, N>, minimizeEdge<S, N>,
    solveEdge<S, N>,    edgeErrors<S, N>,      errorAt<S, N>};
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
