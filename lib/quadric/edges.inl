// quadric: the errors and minimizers of edges. Part of kernels.inl.
#include "lanes.inl"

namespace tetstream {
namespace {

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
void solveEdges(const VertexTable<S>& table, const uint32_t* ends, int count, const S* scale,
                int n_given, S* z, S* errors) {
  if constexpr (N == 0) {  // as above
    for (int k = 0; k < count; ++k) {
      const uint32_t u = ends[2 * k], v = ends[2 * k + 1];
      errors[k] = solveEdge<S, N>(table.quadric(u), table.value(u), table.quadric(v),
                                  table.value(v), scale, n_given, z + k * n_given);
    }
  } else {
    using V = typename Lanes<S>::Eight;
    constexpr int kSize = N * (N + 1) / 2 + 1;
    const S *q1[8], *q2[8], *x1[8], *x2[8];
    for (int k = 0; k < 8; ++k) {  // the lanes left over repeat the last edge
      const uint32_t* end = ends + 2 * (k < count ? k : count - 1);
      q1[k] = table.quadric(end[0]);
      q2[k] = table.quadric(end[1]);
      x1[k] = table.value(end[0]);
      x2[k] = table.value(end[1]);
    }
    EdgeSolver<S, V, N> edges;
    V from[(N + 3) / 4 * 4], error;
    for (int i = 0; i < kSize; i += 4) {
      loadColumns(q1, i, edges.a1 + i);
      loadColumns(q2, i, edges.a2 + i);
    }
    for (int i = 0; i < N; i += 4) {
      loadColumns(x1, i, from + i);
      loadColumns(x2, i, edges.h + i);
    }
    for (int i = 0; i < N; ++i) edges.h[i] = S(0.5) * ((edges.h[i] - from[i]) * scale[i]);
    edges.solve(N);
    edges.measure(N, &error);
    for (int k = 0; k < count; ++k) {
      errors[k] = error[k];
      for (int i = 0; i < N; ++i) z[k * N + i] = edges.z[i][k];
    }
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

}  // namespace
}  // namespace tetstream
