// mesh: orientationLanes for x86-64-v3 processors; this file alone is compiled for them.
#ifdef TETSTREAM_V3_KERNELS
#include "orient_lanes.inl"

namespace tetstream {

void orientationLanesV3(const double x[3], const TriangleLanes& triangles, signed char sign[kLanes],
                        double shape[kLanes]) {
  lanes(x, triangles, sign, shape);
}

}  // namespace tetstream
#endif
