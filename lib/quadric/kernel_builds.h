// quadric: the builds of the kernels, one per instruction set. Internal to the room.
#pragma once

#include "kernels.h"

namespace tetstream {

const QuadricKernels<float>& plainKernelsFloat(int n);
const QuadricKernels<double>& plainKernelsDouble(int n);
#ifdef TETSTREAM_V3_KERNELS
const QuadricKernels<float>& v3KernelsFloat(int n);
const QuadricKernels<double>& v3KernelsDouble(int n);
#endif

}  // namespace tetstream
