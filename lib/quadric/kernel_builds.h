// quadric: the builds of the kernels, one per instruction set. Internal to the room.
#pragma once

#include "kernels.h"

namespace tetstream {

const QuadricKernels<float>& plainKernelsFloat(QuadricLayout layout, int n);
const QuadricKernels<double>& plainKernelsDouble(QuadricLayout layout, int n);
#ifdef TETSTREAM_V3_KERNELS
const QuadricKernels<float>& v3KernelsFloat(QuadricLayout layout, int n);
const QuadricKernels<double>& v3KernelsDouble(QuadricLayout layout, int n);
#endif

}  // namespace tetstream
