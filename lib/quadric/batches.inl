// quadric: edges taken from a table of vertices, eight side by side. Part of kernels.inl.
#include "edges.inl"

namespace tetstream {
namespace {

static_assert(kEdgeLanes == 8);

template <class Layout, class S, int N>
S solveEdge(const S* q1, const S* x1, const S* q2, const S* x2, const S* scale, int n_given, S* z) {
  const int n = dimension<N>(n_given);
  EdgeSolver<Layout, S, S, N> edge;
  if constexpr (kFitsStack<Layout, N>) {
    for (int i = 0; i < Layout::size(n); ++i) {
      edge.a1[i] = q1[i];
      edge.a2[i] = q2[i];
    }
  } else {
    edge.a1 = q1;
    edge.a2 = q2;
  }
  for (int i = 0; i < n; ++i) edge.h[i] = S(0.5) * ((x2[i] - x1[i]) * scale[i]);
  edge.solve(n);
  S error;
  edge.measure(n, &error);
  for (int i = 0; i < n; ++i) z[i] = edge.z[i];
  return error;
}

// Half of the edges from one vertex to eight.
[[gnu::always_inline]] inline void halfEdges(const float* from, const float* const to[8],
                                             const float* scale, int n, Float8* h) {
  for (int i = 0; i < n; i += 4) loadColumns<float>(to, i, h + i);
  for (int i = 0; i < n; ++i) h[i] = 0.5f * ((h[i] - from[i]) * scale[i]);
}
// Rounded when they are differences: far from the origin nothing is lost.
[[gnu::always_inline]] inline void halfEdges(const double* from, const double* const to[8],
                                             const double* scale, int n, Float8* h) {
  for (int i = 0; i < n; i += 4) {
    Double4 half = Double4{};
    for (int j = 0; j < 4 && i + j < n; ++j) half[j] = 0.5 * scale[i + j];
    Float4 r[8];
    for (int k = 0; k < 8; ++k)
      r[k] = __builtin_convertvector((fourAt(to[k] + i) - fourAt(from + i)) * half, Float4);
    toColumns<float>(r, h + i);
  }
}

template <class Layout, class S, int N>
void edgeErrors(const VertexTable<S>& table, uint32_t u, const uint32_t* others, int count,
                const S* scale, int n_given, S* errors) {
  if constexpr (!kFitsStack<Layout, N>) {
    S z[kMaxDimension];
    for (int i = 0; i < count; ++i)
      errors[i] =
          solveEdge<Layout, S, N>(table.quadric(u), table.value(u), table.quadric(others[i]),
                                  table.value(others[i]), scale, n_given, z);
  } else {
    const int n = dimension<N>(n_given), size = Layout::size(n);
    const S *qu = table.quadric(u), *xu = table.value(u);
    EdgeSolver<Layout, float, Float8, N> edges;
    for (int i = 0; i < size; ++i) edges.a1[i] = Float8{} + static_cast<float>(qu[i]);
    for (int first = 0; first < count; first += 8) {
      const int filled = count - first < 8 ? count - first : 8;
      const S *q[8], *x[8];
      for (int k = 0; k < 8; ++k) {  // the lanes left over repeat the last edge
        const uint32_t v = others[first + (k < filled ? k : filled - 1)];
        q[k] = table.quadric(v);
        x[k] = table.value(v);
      }
      for (int i = 0; i < size; i += 4) loadColumns<float>(q, i, edges.a2 + i);
      halfEdges(xu, x, scale, n, edges.h);
      edges.solve(n);
      Float8 error;
      edges.measure(n, &error);
      const auto written = __builtin_convertvector(error, typename Lanes<S>::Eight);
      __builtin_memcpy(errors + first, &written, sizeof written);
    }
  }
}

template <class Layout, class S, int N>
void solveEdges(const VertexTable<S>& table, const uint32_t* ends, int count, const S* scale,
                int n_given, S* z, S* errors) {
  if constexpr (!kFitsStack<Layout, N>) {
    for (int k = 0; k < count; ++k) {
      const uint32_t u = ends[2 * k], v = ends[2 * k + 1];
      errors[k] = solveEdge<Layout, S, N>(table.quadric(u), table.value(u), table.quadric(v),
                                          table.value(v), scale, n_given, z + k * n_given);
    }
  } else {
    using V = typename Lanes<S>::Eight;
    const int n = dimension<N>(n_given), size = Layout::size(n);
    const S *q1[8], *q2[8], *x1[8], *x2[8];
    for (int k = 0; k < 8; ++k) {  // the lanes left over repeat the last edge
      const uint32_t* end = ends + 2 * (k < count ? k : count - 1);
      q1[k] = table.quadric(end[0]);
      q2[k] = table.quadric(end[1]);
      x1[k] = table.value(end[0]);
      x2[k] = table.value(end[1]);
    }
    EdgeSolver<Layout, S, V, N> edges;
    V from[kValueRoom<N>], error;
    for (int i = 0; i < size; i += 4) {
      loadColumns<S>(q1, i, edges.a1 + i);
      loadColumns<S>(q2, i, edges.a2 + i);
    }
    for (int i = 0; i < n; i += 4) {
      loadColumns<S>(x1, i, from + i);
      loadColumns<S>(x2, i, edges.h + i);
    }
    for (int i = 0; i < n; ++i) edges.h[i] = S(0.5) * ((edges.h[i] - from[i]) * scale[i]);
    edges.solve(n);
    edges.measure(n, &error);
    for (int k = 0; k < count; ++k) {
      errors[k] = error[k];
      for (int i = 0; i < n; ++i) z[k * n + i] = edges.z[i][k];
    }
  }
}

}  // namespace
}  // namespace tetstream
