#include "kernels.h"

#include "kernel_builds.h"

namespace tetstream {

static bool hasV3() {
#ifdef TETSTREAM_V3_KERNELS
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2");
#else
  return false;
#endif
}

const char* kernelBuild() {
  return hasV3() ? "x86-64-v3" : "plain";
}

template <>
const QuadricKernels<float>& quadricKernels<float>(int n) {
#ifdef TETSTREAM_V3_KERNELS
  if (hasV3()) return v3KernelsFloat(n);
#endif
  return plainKernelsFloat(n);
}

template <>
const QuadricKernels<double>& quadricKernels<double>(int n) {
#ifdef TETSTREAM_V3_KERNELS
  if (hasV3()) return v3KernelsDouble(n);
#endif
  return plainKernelsDouble(n);
}

}  // namespace tetstream
