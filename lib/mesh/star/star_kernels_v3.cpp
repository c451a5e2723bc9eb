// mesh: the star kernels for x86-64-v3 processors; this file alone is compiled for them.
#ifdef TETSTREAM_V3_KERNELS
#include "star_kernels_v3.h"
#include "star_kernels.inl"
#include "star_walks.inl"

namespace tetstream::v3 {

StarShape starShape(const double x[3], const float* values, int stride, double scale,
                    const StarCell* cells, size_t count, const ThinAngle& thin) {
  return starShapeOf(x, values, stride, scale, cells, count, thin);
}
StarShape starShape(const double x[3], const double* values, int stride, double scale,
                    const StarCell* cells, size_t count, const ThinAngle& thin) {
  return starShapeOf(x, values, stride, scale, cells, count, thin);
}
NearestCell nearestCell(const double x[3], const float* values, int stride, double scale,
                        uint32_t c, const StarCell* cells, size_t count) {
  return nearestCellOf(x, values, stride, scale, c, cells, count);
}
NearestCell nearestCell(const double x[3], const double* values, int stride, double scale,
                        uint32_t c, const StarCell* cells, size_t count) {
  return nearestCellOf(x, values, stride, scale, c, cells, count);
}
StarCounts lookRound(const uint16_t* corners, uint16_t* cells, uint32_t count, uint16_t v,
                     uint16_t other, StarCell* star, StarCell* ring) {
  return lookRoundOf(corners, cells, count, v, other, star, ring);
}
size_t listVertices(const uint16_t* corners, const uint16_t* cells, uint32_t count, uint32_t* seen,
                    uint32_t mark, uint32_t* out) {
  return listVerticesOf(corners, cells, count, seen, mark, out);
}
size_t listVertices(const StarCell* cells, size_t count, uint32_t* seen, uint32_t mark,
                    uint32_t* out) {
  return listVerticesOf(cells, count, seen, mark, out);
}
void addToLinkSums(const uint32_t corners[4], bool negative, const uint32_t taken[4],
                   uint64_t* sums) {
  addToLinkSumsOf(corners, negative, taken, sums);
}

}  // namespace tetstream::v3
#endif
