// quadric: the minimizers of edges by elimination, for one or eight at a time. Part of kernels.inl.
#pragma once

#include "layouts.inl"

namespace tetstream {
namespace {

// The direct solve, for one edge (V is S) or eight (V is a vector of S): the same operations in the
// same order.
template <class Layout, class S, class V, int N>
struct EdgeSolver;

// A quadric's numbers, or where they are.
template <class V, int Size, bool Fits>
struct HeldQuadric {
  using Type = V[Size];
};
template <class V, int Size>
struct HeldQuadric<V, Size, false> {
  using Type = const V*;
};

template <class S, class V, int N>
struct EdgeSolver<Full, S, V, N> {
  static constexpr int kSize = kQuadricRoom<Full, N>;
  typename HeldQuadric<V, kSize, kFitsStack<Full, N>>::Type a1, a2;  // A, then e
  V h[kValueRoom<N>], z[kRoom<N>];                                   // half the edge, the minimizer

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
    const int e = Full::size(n) - 1;
    *error = a1[e] + a2[e] + (rise1 < none ? none : rise1) + (rise2 < none ? none : rise2);
  }
};

// Components meet in space only: each is eliminated alone, into C and the three rows of space.
template <class S, class V, int N>
struct EdgeSolver<Fields, S, V, N> {
  V a1[kQuadricRoom<Fields, N>], a2[kQuadricRoom<Fields, N>];  // the quadrics: A, then e
  V h[kValueRoom<N>], z[kRoom<N>];                             // half the edge, the minimizer

  // As above. Between the two halves z holds the right sides of the components.
  void solve(int n_given) {
    const int n = dimension<N>(n_given);
    V r[3], m[6], inverse[3], inverse_weight = V{}, ridge = V{};
    for (int i = 0; i < 3; ++i) r[i] = V{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) {
        m[at(i, j)] = a1[at(i, j)] + a2[at(i, j)];
        const V b = a2[at(i, j)] - a1[at(i, j)];
        r[i] += b * h[j];
        if (j < i) r[j] += b * h[i];
        if (j == i) ridge += m[at(i, j)];
      }
    if (n > 3) eliminate(n, m, r, &inverse_weight);
    for (int p = 2; p >= 0; --p) {
      inverse[p] = S(1) / ((m[at(p, p)] + S(kSolveWeight) * ridge) + S(1e-30));  // never 1 / 0
      for (int i = 0; i < p; ++i) {
        const V factor = m[at(p, i)] * inverse[p];
        for (int j = 0; j <= i; ++j) m[at(i, j)] -= factor * m[at(p, j)];
        r[i] -= factor * r[p];
      }
    }
    for (int p = 0; p < 3; ++p) {
      for (int i = 0; i < p; ++i) r[p] -= m[at(p, i)] * z[i];
      z[p] = r[p] * inverse[p];
    }
    for (int f = 3; f < n; ++f) {
      const int g = Fields::gradient(f);
      V right = z[f];
      for (int i = 0; i < 3; ++i) right -= (a1[g + i] + a2[g + i]) * z[i];
      z[f] = right * inverse_weight;
    }
  }

  void measure(int n_given, V* error) const {
    const int n = dimension<N>(n_given);
    const V none = V{};
    V rise1 = none, rise2 = none;
    for (int i = 0; i < 3; ++i) {
      V row1 = none, row2 = none;
      for (int j = 0; j < i; ++j) {
        row1 += a1[at(i, j)] * (z[j] + h[j]);
        row2 += a2[at(i, j)] * (z[j] - h[j]);
      }
      const V d1 = z[i] + h[i], d2 = z[i] - h[i];
      rise1 += d1 * (S(2) * row1 + a1[at(i, i)] * d1);
      rise2 += d2 * (S(2) * row2 + a2[at(i, i)] * d2);
    }
    const int w = Fields::weight(n), e = Fields::size(n) - 1;
    for (int f = 3; f < n; ++f) {
      V row1 = none, row2 = none;
      for (int j = 0; j < 3; ++j) {
        row1 += a1[Fields::gradient(f) + j] * (z[j] + h[j]);
        row2 += a2[Fields::gradient(f) + j] * (z[j] - h[j]);
      }
      const V d1 = z[f] + h[f], d2 = z[f] - h[f];
      rise1 += d1 * (S(2) * row1 + a1[w] * d1);
      rise2 += d2 * (S(2) * row2 + a2[w] * d2);
    }
    *error = a1[e] + a2[e] + (rise1 < none ? none : rise1) + (rise2 < none ? none : rise2);
  }

 private:
  // Their right sides first, then one after the other goes into m and r, the last one first.
  void eliminate(int n_given, V* m, V* r, V* inverse_weight) {
    const int n = dimension<N>(n_given), w = Fields::weight(n);
    const V b_weight = a2[w] - a1[w], inverse = S(1) / ((a1[w] + a2[w]) + S(1e-30));
    for (int f = 3; f < n; ++f) {
      const int g = Fields::gradient(f);
      V right = V{};
      for (int j = 0; j < 3; ++j) {
        const V b = a2[g + j] - a1[g + j];
        right += b * h[j];
        r[j] += b * h[f];
      }
      z[f] = right + b_weight * h[f];
    }
    for (int f = n - 1; f >= 3; --f) {
      const int g = Fields::gradient(f);
      V row[3];
      for (int i = 0; i < 3; ++i) row[i] = a1[g + i] + a2[g + i];
      for (int i = 0; i < 3; ++i) {
        const V factor = row[i] * inverse;
        for (int j = 0; j <= i; ++j) m[at(i, j)] -= factor * row[j];
        r[i] -= factor * z[f];
      }
    }
    *inverse_weight = inverse;
  }
};

}  // namespace
}  // namespace tetstream
