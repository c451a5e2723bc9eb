// mesh: the star kernels for any processor, and the choice between the builds.
#include "star_kernels.h"

#include <algorithm>
#include <cmath>

#include "processor.h"
#include "star_kernels.inl"
#include "star_kernels_v3.h"
#include "star_walks.inl"

namespace tetstream {

#ifdef TETSTREAM_V3_KERNELS
static const bool has_v3 = processorHasV3();
#define TETSTREAM_BEST(kernel, ...) (has_v3 ? v3::kernel(__VA_ARGS__) : kernel##Of(__VA_ARGS__))
#else
#define TETSTREAM_BEST(kernel, ...) kernel##Of(__VA_ARGS__)
#endif

ThinAngle::ThinAngle(double angle) : degrees(angle) {
  const double sine = std::sin(degrees * (3.14159265358979323846 / 180));
  cos2 = 1 - sine * sine;
  shape = std::min(4 * sine * sine, 1.0);
}

template <class S>
StarShape starShape(const double x[3], const S* values, int stride, double scale,
                    const StarCell* cells, size_t count, const ThinAngle& thin) {
  return TETSTREAM_BEST(starShape, x, values, stride, scale, cells, count, thin);
}

template <class S>
NearestCell nearestCell(const double x[3], const S* values, int stride, double scale, uint32_t c,
                        const StarCell* cells, size_t count) {
  return TETSTREAM_BEST(nearestCell, x, values, stride, scale, c, cells, count);
}

StarCounts lookRound(const uint16_t* corners, uint16_t* cells, uint32_t count, uint16_t v,
                     uint16_t other, StarCell* star, StarCell* ring) {
  return TETSTREAM_BEST(lookRound, corners, cells, count, v, other, star, ring);
}

size_t listVertices(const uint16_t* corners, const uint16_t* cells, uint32_t count, uint32_t* seen,
                    uint32_t mark, uint32_t* out) {
  return TETSTREAM_BEST(listVertices, corners, cells, count, seen, mark, out);
}

size_t listVertices(const StarCell* cells, size_t count, uint32_t* seen, uint32_t mark,
                    uint32_t* out) {
  return TETSTREAM_BEST(listVertices, cells, count, seen, mark, out);
}

void addToLinkSums(const uint32_t corners[4], bool negative, const uint32_t taken[4],
                   uint64_t* sums) {
  TETSTREAM_BEST(addToLinkSums, corners, negative, taken, sums);
}

template StarShape starShape(const double[3], const float*, int, double, const StarCell*, size_t,
                             const ThinAngle&);
template StarShape starShape(const double[3], const double*, int, double, const StarCell*, size_t,
                             const ThinAngle&);
template NearestCell nearestCell(const double[3], const float*, int, double, uint32_t,
                                 const StarCell*, size_t);
template NearestCell nearestCell(const double[3], const double*, int, double, uint32_t,
                                 const StarCell*, size_t);

}  // namespace tetstream
