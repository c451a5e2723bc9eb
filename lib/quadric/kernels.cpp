// quadric: the choice between the builds of the kernels. Depends on processor.h.
#include "kernels.h"

#include "kernel_builds.h"
#include "processor.h"

namespace tetstream {

const char* kernelBuild() {
#ifdef TETSTREAM_V3_KERNELS
  if (processorHasV3()) return "x86-64-v3";
#endif
  return "plain";
}

template <>
const QuadricKernels<float>& quadricKernels<float>(QuadricLayout layout, int n) {
#ifdef TETSTREAM_V3_KERNELS
  if (processorHasV3()) return v3KernelsFloat(layout, n);
#endif
  return plainKernelsFloat(layout, n);
}

template <>
const QuadricKernels<double>& quadricKernels<double>(QuadricLayout layout, int n) {
#ifdef TETSTREAM_V3_KERNELS
  if (processorHasV3()) return v3KernelsDouble(layout, n);
#endif
  return plainKernelsDouble(layout, n);
}

}  // namespace tetstream
