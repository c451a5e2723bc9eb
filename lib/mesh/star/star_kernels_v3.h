// mesh/star: the star kernels' build for x86-64-v3 processors. Internal to the room.
#pragma once

#include "star_kernels.h"

namespace tetstream::v3 {

StarShape starShape(const double x[3], const float* values, int stride, double scale,
                    const StarCell* cells, size_t count, const ThinAngle& thin);
StarShape starShape(const double x[3], const double* values, int stride, double scale,
                    const StarCell* cells, size_t count, const ThinAngle& thin);
NearestCell nearestCell(const double x[3], const float* values, int stride, double scale,
                        uint32_t c, const StarCell* cells, size_t count);
NearestCell nearestCell(const double x[3], const double* values, int stride, double scale,
                        uint32_t c, const StarCell* cells, size_t count);
StarCounts lookRound(const uint16_t* corners, uint16_t* cells, uint32_t count, uint16_t v,
                     uint16_t other, StarCell* star, StarCell* ring);
size_t listVertices(const uint16_t* corners, const uint16_t* cells, uint32_t count, uint32_t* seen,
                    uint32_t mark, uint32_t* out);
size_t listVertices(const StarCell* cells, size_t count, uint32_t* seen, uint32_t mark,
                    uint32_t* out);
void addToLinkSums(const uint32_t corners[4], bool negative, const uint32_t taken[4],
                   uint64_t* sums);

}  // namespace tetstream::v3
