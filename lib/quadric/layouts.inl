// quadric: the layouts of A in memory. Part of kernels.inl.
#pragma once

#include "lanes.inl"

namespace tetstream {
namespace {

inline constexpr int at(int i, int j) {
  return i * (i + 1) / 2 + j;
}  // j <= i

// What a layout keeps: `each` visits its entries row by row, the diagonal last: visit(i, j, place),
// j <= i.
struct Full {
  static constexpr int size(int n) { return quadricSize(QuadricLayout::kFull, n); }
  template <class Visit>
  static inline void each(int n, Visit visit) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) visit(i, j, at(i, j));
  }
};

struct Fields {
  static constexpr int size(int n) { return quadricSize(QuadricLayout::kFields, n); }
  static constexpr int gradient(int f) { return 6 + 3 * (f - 3); }  // of row f >= 3, in G
  static constexpr int weight(int n) { return gradient(n); }        // W
  template <class Visit>
  static inline void each(int n, Visit visit) {
    Full::each(3, visit);
    for (int f = 3; f < n; ++f) {
      for (int j = 0; j < 3; ++j) visit(f, j, gradient(f) + j);
      visit(f, f, weight(n));
    }
  }
};

// Whether copies of its quadrics go onto the stack; large triangles would need a large one.
template <class Layout, int N>
constexpr bool kFitsStack = N > 0 || Layout::size(kMaxDimension) < 1000;

// Numbers of A and e, and of values, with room for reading four at a time.
template <class Layout, int N>
constexpr int kQuadricRoom = (Layout::size(kRoom<N>) + 3) / 4 * 4;
template <int N>
constexpr int kValueRoom = (kRoom<N> + 3) / 4 * 4;

template <class S, int N>
void rescaleFull(const S* factor, S weight, int n_given, S* q) {
  const int n = dimension<N>(n_given);
  Full::each(n, [&](int i, int j, int k) { q[k] *= weight * (factor[i] * factor[j]); });
  q[Full::size(n) - 1] *= weight;
}

// Of component f, G_f G_f^T / W is in C: what of the sum of all cells' gradients is their mean's.
// It can be weighed anew; the rest, which C has of all components together, keeps its weight.
template <class S, int N>
void rescaleFields(const S* factor, S weight, int n_given, S* q) {
  const int n = dimension<N>(n_given), w = Fields::weight(n);
  S least = S(1);
  for (int f = 3; f < n; ++f) least = f == 3 || factor[f] < least ? factor[f] : least;
  for (int f = 3; f < n; ++f) {
    const double rise = static_cast<double>(factor[f]) / static_cast<double>(least);
    if (!(rise > 1) || !(q[w] > 0)) continue;
    S* g = q + Fields::gradient(f);
    const double share = 1 / (rise * rise), surplus = (1 - share) / static_cast<double>(q[w]);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        q[at(i, j)] -=
            static_cast<S>(surplus * (static_cast<double>(g[i]) * static_cast<double>(g[j])));
    for (int j = 0; j < 3; ++j) g[j] = static_cast<S>(share * static_cast<double>(g[j]));
  }
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) q[at(i, j)] *= weight * (factor[i] * factor[j]);
  for (int f = 3; f < n; ++f)
    for (int j = 0; j < 3; ++j) q[Fields::gradient(f) + j] *= weight * (factor[f] * factor[j]);
  if (n > 3) q[w] *= weight * (least * least);
  q[Fields::size(n) - 1] *= weight;
}

// The derivative by component f is G_f x + W f and what is constant.
template <class S, int N>
void followFields(const S* q1, const S* q2, int n_given, const S* step, S* z) {
  const int n = dimension<N>(n_given), w = Fields::weight(n);
  const S weight = n > 3 ? q1[w] + q2[w] : S(0);
  if (!(weight > 0)) return;
  for (int f = 3; f < n; ++f) {
    const S *a = q1 + Fields::gradient(f), *b = q2 + Fields::gradient(f);
    S change = 0;
    for (int j = 0; j < 3; ++j) change += (a[j] + b[j]) * step[j];
    z[f] -= change / weight;
  }
}

template <class S>
void followNothing(const S*, const S*, int, const S*, S*) {}

template <class S>
void spaceOfFull(const S* q1, const S* q2, int, S* form) {
  for (int k = 0; k < at(3, 0); ++k) form[k] = q1[k] + q2[k];
}

// C less the sum of G_f G_f^T / W.
template <class S, int N>
void spaceOfFields(const S* q1, const S* q2, int n_given, S* form) {
  const int n = dimension<N>(n_given), w = Fields::weight(n);
  spaceOfFull(q1, q2, n, form);
  const S weight = n > 3 ? q1[w] + q2[w] : S(0);
  if (!(weight > 0)) return;
  for (int f = 3; f < n; ++f) {
    const S *a = q1 + Fields::gradient(f), *b = q2 + Fields::gradient(f);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) form[at(i, j)] -= (a[i] + b[i]) * (a[j] + b[j]) / weight;
  }
}

}  // namespace
}  // namespace tetstream
