// mesh: the thinness of several cells for x86-64-v3 processors; this file alone is compiled for
// them.
#ifdef TETSTREAM_V3_KERNELS
#include "thinness_v3.h"

#include "thinness.inl"

namespace tetstream::v3 {

void thinnessOfFour(const float* values, int stride, const uint32_t (*corners)[4], double* out) {
  thinnessOfFourOf(values, stride, corners, out);
}
void thinnessOfFour(const double* values, int stride, const uint32_t (*corners)[4], double* out) {
  thinnessOfFourOf(values, stride, corners, out);
}

}  // namespace tetstream::v3
#endif
