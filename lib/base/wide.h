// base: numbers side by side, one float32 to one float64. Compiled once per instruction set, as the
// kernels that include it.
#pragma once

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace tetstream {
namespace {

typedef float FourFloats __attribute__((vector_size(16)));
typedef double FourDoubles __attribute__((vector_size(32)));

[[gnu::always_inline]] inline FourDoubles toDoubles(FourFloats v) {
#ifdef __AVX__  // one instruction, for which GCC 12 takes five
  return reinterpret_cast<FourDoubles>(_mm256_cvtps_pd(reinterpret_cast<__m128>(v)));
#else
  return __builtin_convertvector(v, FourDoubles);
#endif
}
[[gnu::always_inline]] inline FourDoubles toDoubles(FourDoubles v) {
  return v;
}

}  // namespace
}  // namespace tetstream
