// quadric: the kernels for any processor.
#include "kernel_builds.h"
#include "kernels.inl"

namespace tetstream {

const QuadricKernels<float>& plainKernelsFloat(QuadricLayout layout, int n) {
  return kernelsFor<float>(layout, n);
}
const QuadricKernels<double>& plainKernelsDouble(QuadricLayout layout, int n) {
  return kernelsFor<double>(layout, n);
}

}  // namespace tetstream
