// mesh: the bodies of the star kernels, compiled once per instruction set. Plain arithmetic in a
// fixed order, no contraction: the same answers from every build.
#include "orient.h"
#include "star_kernels.h"
#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace tetstream {
namespace {

typedef double Lanes __attribute__((vector_size(32)));
typedef float FloatLanes __attribute__((vector_size(16)));
typedef long long LaneMask __attribute__((vector_size(32)));
constexpr int kLanes = 4;

// (6 V of the regular cell of edge 1)^2 = 1 / 2; the sum of its six squared edges, cubed: 216.
constexpr double kRegular = 432;

// Products that underflow are outside the filter's bound, and squares of determinants must not
// over- or underflow: beyond these the careful path is taken.
constexpr double kLeastDeterminant = 1e-110, kLargestSum = 1e74;

inline Lanes loadPoint(const float* p) {
  FloatLanes v;
  __builtin_memcpy(&v, p, sizeof v);
  return __builtin_convertvector(v, Lanes);
}
inline Lanes loadPoint(const double* p) {
  Lanes v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}

inline Lanes magnitude(Lanes v) {
  return v < 0 ? -v : v;
}

// Coordinate by coordinate, of one corner of four cells, relative to x.
struct Corner {
  Lanes x, y, z;
};
template <class S>
inline Corner corner(const S* values, size_t stride, const StarCell* const c[kLanes], int k,
                     const double x[3]) {
  const Lanes p0 = loadPoint(values + c[0]->t[k] * stride);
  const Lanes p1 = loadPoint(values + c[1]->t[k] * stride);
  const Lanes p2 = loadPoint(values + c[2]->t[k] * stride);
  const Lanes p3 = loadPoint(values + c[3]->t[k] * stride);
  const Lanes low01 = __builtin_shufflevector(p0, p1, 0, 4, 2, 6);   // x0 x1 z0 z1
  const Lanes low23 = __builtin_shufflevector(p2, p3, 0, 4, 2, 6);   // x2 x3 z2 z3
  const Lanes high01 = __builtin_shufflevector(p0, p1, 1, 5, 3, 7);  // y0 y1 . .
  const Lanes high23 = __builtin_shufflevector(p2, p3, 1, 5, 3, 7);
  return {__builtin_shufflevector(low01, low23, 0, 1, 4, 5) - x[0],
          __builtin_shufflevector(high01, high23, 0, 1, 4, 5) - x[1],
          __builtin_shufflevector(low01, low23, 2, 3, 6, 7) - x[2]};
}

inline Lanes squares(Lanes a, Lanes b, Lanes c) {
  return a * a + b * b + c * c;
}

inline Lanes squaredDistance(const Corner& a, const Corner& b) {
  return squares(a.x - b.x, a.y - b.y, a.z - b.z);
}

// Twice the area of a face as a vector, out of the cell.
inline Corner normal(const Corner& a, const Corner& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Lanes inner(const Corner& a, const Corner& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Whether the angle between two faces of squared areas a2, b2 is smaller.
inline LaneMask anglesBelow(const Corner& a, Lanes a2, const Corner& b, Lanes b2, double cos2) {
  const Lanes c = inner(a, b);
  return (c < 0) & (c * c > cos2 * (a2 * b2));
}

// Of the cells (0, p, q, r).
inline LaneMask thinCells(const Corner& p, const Corner& q, const Corner& r, double cos2) {
  const Corner qp = {q.x - p.x, q.y - p.y, q.z - p.z}, rp = {r.x - p.x, r.y - p.y, r.z - p.z};
  const Corner a = normal(q, p), b = normal(r, q), c = normal(p, r), d = normal(qp, rp);
  const Lanes a2 = inner(a, a), b2 = inner(b, b), c2 = inner(c, c), d2 = inner(d, d);
  return anglesBelow(a, a2, b, b2, cos2) | anglesBelow(b, b2, c, c2, cos2) |
         anglesBelow(c, c2, a, a2, cos2) | anglesBelow(a, a2, d, d2, cos2) |
         anglesBelow(b, b2, d, d2, cos2) | anglesBelow(c, c2, d, d2, cos2);
}

inline size_t countLanes(const LaneMask& mask, size_t lanes) {
  size_t count = 0;
  for (size_t k = 0; k < lanes; ++k) count += mask[k] != 0;
  return count;
}

inline bool anyLane(const LaneMask& mask) {
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
}

// One cell that the filter could not decide, or of a size whose products it cannot hold.
template <class S>
inline bool carefully(const double x[3], const S* values, size_t stride, const StarCell& cell,
                      const ThinAngle& thin, size_t* count) {
  double t[3][3];
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) t[i][j] = static_cast<double>(values[cell.t[i] * stride + j]);
  if (orientation(x, t[0], t[1], t[2]) <= 0) return false;
  const double scale = 1 / largestDifference(x, t[0], t[1], t[2]);
  Corner c[3];
  for (int i = 0; i < 3; ++i)
    c[i] = {Lanes{} + (t[i][0] - x[0]) * scale, Lanes{} + (t[i][1] - x[1]) * scale,
            Lanes{} + (t[i][2] - x[2]) * scale};
  *count += thinCells(c[0], c[1], c[2], thin.cos2)[0] != 0;
  return true;
}

template <class S>
inline StarShape starShapeOf(const double x[3], const S* values, int stride_given,
                             const StarCell* cells, size_t count, const ThinAngle& thin) {
  const size_t stride = static_cast<size_t>(stride_given);
  size_t thin_cells = 0;
  for (size_t first = 0; first < count; first += kLanes) {
    const size_t filled = count - first < kLanes ? count - first : kLanes;
    const StarCell* c[kLanes];  // the lanes left over repeat the last cell
    for (size_t k = 0; k < kLanes; ++k) c[k] = cells + first + (k < filled ? k : filled - 1);
    const Corner p = corner(values, stride, c, 0, x), q = corner(values, stride, c, 1, x),
                 r = corner(values, stride, c, 2, x);
    const Lanes p1 = q.y * r.z, p2 = q.z * r.y, p3 = q.z * r.x, p4 = q.x * r.z, p5 = q.x * r.y,
                p6 = q.y * r.x;
    const Lanes det = p.x * (p1 - p2) + p.y * (p3 - p4) + p.z * (p5 - p6);
    const Lanes bound = kOrientationBound * (magnitude(p.x) * (magnitude(p1) + magnitude(p2)) +
                                             magnitude(p.y) * (magnitude(p3) + magnitude(p4)) +
                                             magnitude(p.z) * (magnitude(p5) + magnitude(p6)));
    const Lanes sum = squares(p.x, p.y, p.z) + squares(q.x, q.y, q.z) + squares(r.x, r.y, r.z) +
                      squaredDistance(p, q) + squaredDistance(q, r) + squaredDistance(r, p);
    const LaneMask held = sum < kLargestSum;
    if (anyLane((det < -bound) & (det < -kLeastDeterminant) & held)) return {false, 0};
    const LaneMask sure = (det > bound) & (det > kLeastDeterminant) & held;
    const LaneMask suspect = sure & (kRegular * (det * det) < thin.shape * (sum * sum * sum));
    if (anyLane(suspect)) thin_cells += countLanes(suspect & thinCells(p, q, r, thin.cos2), filled);
    if (!anyLane(~sure)) continue;
    for (size_t k = 0; k < filled; ++k)
      if (!sure[k] && !carefully(x, values, stride, *c[k], thin, &thin_cells)) return {false, 0};
  }
  return {true, thin_cells};
}

// ---------------------------------------------------------------------------------- gathering

#ifdef __AVX2__
// Byte places of t0, t1, t2 as 32-bit numbers after the corner, seen from corner j; j = 4: nothing.
alignas(16) constexpr int8_t kLook[5][16] = {
    {-1, -1, -1, -1, 2, 3, -1, -1, 4, 5, -1, -1, 6, 7, -1, -1},
    {-1, -1, -1, -1, 0, 1, -1, -1, 6, 7, -1, -1, 4, 5, -1, -1},
    {-1, -1, -1, -1, 0, 1, -1, -1, 2, 3, -1, -1, 6, 7, -1, -1},
    {-1, -1, -1, -1, 0, 1, -1, -1, 4, 5, -1, -1, 2, 3, -1, -1},
    {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1}};
static_assert(sizeof(StarCell) == 16 && offsetof(StarCell, t) == 4);

inline StarCounts lookRoundOf(const uint16_t* corners, uint16_t* cells, uint32_t count, uint16_t v,
                              uint16_t other, StarCell* star, StarCell* ring) {
  const __m128i all_v = _mm_set1_epi16(static_cast<short>(v)),
                all_other = _mm_set1_epi16(static_cast<short>(other));
  uint32_t kept = 0, in_ring = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint16_t cell = cells[i];
    const __m128i corner =
        _mm_loadl_epi64(reinterpret_cast<const __m128i*>(corners + 4 * size_t{cell}));
    const unsigned at = static_cast<unsigned>(_mm_movemask_epi8(_mm_cmpeq_epi16(corner, all_v)));
    const uint32_t j = static_cast<uint32_t>(__builtin_ctz(at | 0x100)) / 2;
    const bool both = _mm_movemask_epi8(_mm_cmpeq_epi16(corner, all_other)) & 0xff;
    const bool live = at & 0xff;
    const __m128i look = _mm_load_si128(reinterpret_cast<const __m128i*>(kLook[j]));
    const __m128i seen = _mm_or_si128(_mm_shuffle_epi8(corner, look),
                                      _mm_cvtsi32_si128(static_cast<int>(4 * cell + j)));
    cells[kept + in_ring] = cell;
    _mm_storeu_si128(reinterpret_cast<__m128i*>(both ? ring + in_ring : star + kept), seen);
    kept += live & !both;
    in_ring += live & both;
  }
  return {kept, in_ring};
}
#else
inline StarCounts lookRoundOf(const uint16_t* corners, uint16_t* cells, uint32_t count, uint16_t v,
                              uint16_t other, StarCell* star, StarCell* ring) {
  uint32_t kept = 0, in_ring = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint16_t cell = cells[i];
    const uint16_t* corner = corners + 4 * size_t{cell};
    if (corner[0] == kGoneCorner) continue;
    const uint32_t j =
        uint32_t{corner[1] == v} + 2 * uint32_t{corner[2] == v} + 3 * uint32_t{corner[3] == v};
    const bool both =
        (corner[0] == other) | (corner[1] == other) | (corner[2] == other) | (corner[3] == other);
    cells[kept + in_ring] = cell;
    StarCell& out = both ? ring[in_ring++] : star[kept++];
    out.corner = 4 * uint32_t{cell} + j;
    for (int k = 0; k < 3; ++k) out.t[k] = corner[kOpposite[j][k]];
  }
  return {kept, in_ring};
}
#endif

// Without branches, since there is no pattern in what was seen before.
inline size_t listVerticesOf(const uint16_t* corners, const uint16_t* cells, uint32_t count,
                             uint32_t* seen, uint32_t mark, uint32_t* out) {
  size_t listed = 0;
  for (uint32_t i = 0; i < count; ++i)
    for (int k = 0; k < 4; ++k) {
      const uint16_t v = corners[4 * size_t{cells[i]} + static_cast<size_t>(k)];
      out[listed] = v;
      listed += seen[v] < mark;
      seen[v] = seen[v] < mark ? mark : seen[v];
    }
  return listed;
}

}  // namespace
}  // namespace tetstream
