// quadric: numbers side by side, and what the bodies of the kernels share. Part of kernels.inl.
#pragma once

#include "kernels.h"
#include "wide.h"

namespace tetstream {
namespace {

// The dimension: known to the compiler where N > 0.
template <int N>
inline int dimension(int n) {
  return N > 0 ? N : n;
}

template <int N>
constexpr int kRoom = N > 0 ? N : kMaxDimension;

typedef float Float8 __attribute__((vector_size(32)));
using Float4 = FourFloats;
typedef double Double8 __attribute__((vector_size(64)));
using Double4 = FourDoubles;

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

// Functions on vectors must be inlined: no call passes those that are wider than the processor's.

template <class S>
[[gnu::always_inline]] inline typename Lanes<S>::Four fourAt(const S* p) {
  typename Lanes<S>::Four r;
  __builtin_memcpy(&r, p, sizeof r);
  return r;
}

// Four numbers of each of eight rows, as four columns.
template <class S>
[[gnu::always_inline]] inline void toColumns(const typename Lanes<S>::Four r[8],
                                             typename Lanes<S>::Eight* columns) {
  typename Lanes<S>::Eight a[4];
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

// rows[k][first .. first + 4) of eight rows, as four columns, rounded to T.
template <class T, class S>
[[gnu::always_inline]] inline void loadColumns(const S* const rows[8], int first,
                                               typename Lanes<T>::Eight* columns) {
  typename Lanes<T>::Four r[8];
  for (int k = 0; k < 8; ++k)
    r[k] = __builtin_convertvector(fourAt(rows[k] + first), typename Lanes<T>::Four);
  toColumns<T>(r, columns);
}

template <class T>
[[gnu::always_inline]] inline void transpose(T* r) {
  const T low01 = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5);
  const T high01 = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7);
  const T low23 = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5);
  const T high23 = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
  r[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
  r[1] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
  r[2] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
  r[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

}  // namespace
}  // namespace tetstream
