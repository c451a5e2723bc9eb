// quadric: the kernels for any processor.
#include "kernel_builds.h"
#include "kernels.inl"

namespace tetstream {

const QuadricKernels<float>& plainKernelsFloat(int n) {
  return kernelsFor<float>(n);
}
const QuadricKernels<double>& plainKernelsDouble(int n) {
  return kernelsFor<double>(n);
}

}  // namespace tetstream
