// mesh/star: the loops over the cells of a star, built for several instruction sets; all builds
// give the same. Depends on topology.h.
#pragma once

#include <cstddef>

#include "topology.h"

namespace tetstream {

// Cells whose smallest dihedral angle is below this one are thin.
struct ThinAngle {
  explicit ThinAngle(double angle);  // in degrees; 0: no cell is
  double degrees;
  double cos2;          // squared cosine
  double shape;         // no cell of a better shape (below) is thin
  bool barred = false;  // a thin cell counts as one that is not positive
  // Of smaller angles, the second smaller than the first: thin cells below those are counted, too.
  double middle_cos2 = 1, inner_cos2 = 1;
};

struct StarShape {
  bool positive;  // every cell strictly, decided exactly; where they are barred none is thin
  size_t thin;    // cells; 0 when not positive
  size_t middle;  // of them those below the first smaller angle, if there is one
  size_t inner;   // and below the second
  size_t turned;  // when not positive: the place of a cell that is not
};

// The cells (x, t0, t1, t2) of a star. Coordinates of vertex v: the first three numbers at
// values + v * stride; four must be readable. x: of the values' type. With float32 values it is
// fastest where `scale`, a power of two, brings edges near 1.
//
// Angles are only measured where 432 V^2 / (mean squared edge)^3, the cube of the mean ratio, 1 for
// the regular cell, is small: it is at most 4 sin^2 of the smallest angle.
template <class S>
StarShape starShape(const double x[3], const S* values, int stride, double scale,
                    const StarCell* cells, size_t count, const ThinAngle& thin);

// Of the cells (c, t0, t1, t2) the one that x lies in, or is nearest to by its smallest barycentric
// coordinate: the cell's place and that number, as good as the values' type has it.
struct NearestCell {
  size_t place;
  double least;
};
template <class S>
NearestCell nearestCell(const double x[3], const S* values, int stride, double scale, uint32_t c,
                        const StarCell* cells, size_t count);

// Cells with 16-bit corners, four to a cell, ordered so that volumes are positive; a dead cell has
// kGoneCorner in their place.
constexpr uint16_t kGoneCorner = 0xffff;
struct StarCounts {
  uint32_t star, ring;
};

// Looks from v at `count` cells that hold it: those that hold `other` go to `ring`, the rest to
// `star`, each with room for all and kStarSlack more; dead ones are passed over, in `cells` too.
constexpr uint32_t kStarSlack = 4;
StarCounts lookRound(const uint16_t* corners, uint16_t* cells, uint32_t count, uint16_t v,
                     uint16_t other, StarCell* star, StarCell* ring);

// The vertices of `count` cells, each once: those whose entry in `seen` is below `mark`, which it
// becomes. `out` has room for 4 * count + 1. Returns their number.
size_t listVertices(const uint16_t* corners, const uint16_t* cells, uint32_t count, uint32_t* seen,
                    uint32_t mark, uint32_t* out);
// The same of the corners t of cells round a vertex, which is not among them; `out` has room for
// 3 * count + 1.
size_t listVertices(const StarCell* cells, size_t count, uint32_t* seen, uint32_t mark,
                    uint32_t* out);

// The link of an inner vertex is closed: each of its edges is there once in each direction. With
// two random numbers to each vertex, (x, y) and (x', y') of an edge, the sum of x y' - x' y over
// all edges of all triangles is zero then, and otherwise only by a chance; of two sums, each of 32
// bits and with numbers of its own, by one of about 2^-60. Adds to the sums of the vertices of a
// cell what the face opposite each has; 0 in `taken`, which otherwise has all bits set: to that
// one's nothing is added.
void addToLinkSums(const uint32_t corners[4], bool negative, const uint32_t taken[4],
                   uint64_t* sums);

}  // namespace tetstream
