// quadric: the error of an edge at a point, and its minimizer by conjugate gradients, in either
// layout. Part of kernels.inl.
#include "layouts.inl"

namespace tetstream {
namespace {

// d^T A d.
template <class Layout, class S>
inline S quadraticForm(const S* a, const S* d, int n) {
  S sum = 0, row = 0;
  Layout::each(n, [&](int i, int j, int k) {
    if (j < i) {
      row += a[k] * d[j];
    } else {
      sum += d[i] * (2 * row + a[k] * d[i]);
      row = 0;
    }
  });
  return sum;
}

// h = half of scale (x2 - x1); returns the error at z.
template <class Layout, class S, int N>
inline S errorFrom(const S* q1, const S* q2, const S* h, int n, const S* z) {
  S d1[kRoom<N>], d2[kRoom<N>];
  for (int i = 0; i < n; ++i) {
    d1[i] = z[i] + h[i];
    d2[i] = z[i] - h[i];
  }
  const int e = Layout::size(n) - 1;
  const S rise1 = quadraticForm<Layout>(q1, d1, n), rise2 = quadraticForm<Layout>(q2, d2, n);
  // A is positive semidefinite up to rounding: the error never falls below e1 + e2. A comparison
  // written this way lets a NaN through to the caller.
  return q1[e] + q2[e] + (rise1 < 0 ? 0 : rise1) + (rise2 < 0 ? 0 : rise2);
}

template <class S>
inline void halfEdge(const S* x1, const S* x2, const S* scale, int n, S* h) {
  for (int i = 0; i < n; ++i) h[i] = S(0.5) * ((x2[i] - x1[i]) * scale[i]);
}

template <class Layout, class S, int N>
S errorAt(const S* q1, const S* x1, const S* q2, const S* x2, const S* scale, int n_given,
          const S* z) {
  const int n = dimension<N>(n_given);
  S h[kRoom<N>];
  halfEdge(x1, x2, scale, n, h);
  return errorFrom<Layout, S, N>(q1, q2, h, n, z);
}

// Fig. 5 of the paper. At the midpoint the residual is A1 p1 + A2 p2 - (A1 + A2) m =
// (A1 - A2)(p1 - p2) / 2, free of cancellation. s t is the Rayleigh quotient along the direction;
// a small one means that the minimum is not determined there, and z stays at the midpoint in it.
template <class Layout, class S, int N>
S minimizeEdge(const S* q1, const S* x1, const S* q2, const S* x2, const S* scale, int n_given,
               S* z) {
  const int n = dimension<N>(n_given);
  constexpr bool kHeld = kFitsStack<Layout, N>;
  S h[kRoom<N>], r[kRoom<N>], d[kRoom<N>], q[kRoom<N>], a[kHeld ? Layout::size(kRoom<N>) : 1];
  halfEdge(x1, x2, scale, n, h);
  S trace = 0;
  for (int i = 0; i < n; ++i) r[i] = d[i] = z[i] = 0;
  Layout::each(n, [&](int i, int j, int k) {
    const S b = q2[k] - q1[k], sum = q1[k] + q2[k];
    if constexpr (kHeld) a[k] = sum;
    r[i] += b * h[j];
    if (j < i)
      r[j] += b * h[i];
    else
      trace += sum;
  });
  const S limit = trace / S(n * kMaxCondition);
  for (int step = 0; step < n; ++step) {
    S s = 0, t = 0;
    for (int i = 0; i < n; ++i) s += r[i] * r[i];
    if (!(s > 0)) break;
    for (int i = 0; i < n; ++i) d[i] += r[i] / s;
    for (int i = 0; i < n; ++i) q[i] = 0;
    Layout::each(n, [&](int i, int j, int k) {
      const S entry = kHeld ? a[kHeld ? k : 0] : q1[k] + q2[k];
      q[i] += entry * d[j];
      if (j < i) q[j] += entry * d[i];
    });
    for (int i = 0; i < n; ++i) t += d[i] * q[i];
    if (!(s * t > limit)) break;
    for (int i = 0; i < n; ++i) {
      r[i] -= q[i] / t;
      z[i] += d[i] / t;
    }
  }
  return errorFrom<Layout, S, N>(q1, q2, h, n, z);
}

}  // namespace
}  // namespace tetstream
