// quadric: the kernels for x86-64-v3 processors (AVX2); this file alone is compiled for them.
#include "kernel_builds.h"
#ifdef TETSTREAM_V3_KERNELS
#include "kernels.inl"

namespace tetstream {

const QuadricKernels<float>& v3KernelsFloat(QuadricLayout layout, int n) {
  return kernelsFor<float>(layout, n);
}
const QuadricKernels<double>& v3KernelsDouble(QuadricLayout layout, int n) {
  return kernelsFor<double>(layout, n);
}

}  // namespace tetstream
#endif
