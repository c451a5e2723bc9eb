// mesh: the bodies of the star kernels, compiled once per instruction set. Plain arithmetic in a
// fixed order, no contraction: the same answers from every build.
#include "orient.h"
#include "star_kernels.h"
#ifdef __AVX2__
#include <immintrin.h>
#endif

namespace tetstream {
namespace {

// As many cells at a time as a 32-byte vector holds of the values' type. A determinant is wrong by
// no more than kBound (kOrientationBound in its type) times the sum of its products' sizes, which
// is at most the sum of the six squared edges to the power of 3/2: squared, one above kSure times
// that has its sign. Within the limits of the sum no square over- or underflows, and what products
// lose by it is smaller by far; beyond, the careful path is taken.
template <class S>
struct Wide;
template <>
struct Wide<double> {
  typedef double Lanes __attribute__((vector_size(32)));
  static constexpr size_t kLanes = 4;
  static constexpr double kBound = kOrientationBound, kSure = 4 * kBound * kBound;
  static constexpr double kLeastSum = 1e-70, kLargestSum = 1e74;
};
template <>
struct Wide<float> {
  typedef float Lanes __attribute__((vector_size(32)));
  static constexpr size_t kLanes = 8;
  static constexpr float kBound = 8.0f / (1 << 24), kSure = 4 * kBound * kBound;
  static constexpr float kLeastSum = 1e-10f, kLargestSum = 1e12f;
};
template <class S>
using LanesOf = typename Wide<S>::Lanes;
typedef float Point __attribute__((vector_size(16)));

// (6 V of the regular cell of edge 1)^2 = 1 / 2; the sum of its six squared edges, cubed: 216.
constexpr double kRegular = 432;
constexpr double kRounding = 1.001;  // more than what squares and cubes lose in float32

// Coordinate by coordinate, of one corner of several cells, relative to x.
template <class L>
struct Corner {
  L x, y, z;
};
inline LanesOf<double> pointAt(const double* p) {
  LanesOf<double> v;
  __builtin_memcpy(&v, p, sizeof v);
  return v;
}
inline LanesOf<float> pointsAt(const float* p, const float* q) {
  Point a, b;
  __builtin_memcpy(&a, p, sizeof a);
  __builtin_memcpy(&b, q, sizeof b);
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}
inline Corner<LanesOf<double>> corner(const double* values, size_t stride, const StarCell* c, int k,
                                      const double x[3]) {
  const auto p0 = pointAt(values + c[0].t[k] * stride), p1 = pointAt(values + c[1].t[k] * stride),
             p2 = pointAt(values + c[2].t[k] * stride), p3 = pointAt(values + c[3].t[k] * stride);
  const auto low01 = __builtin_shufflevector(p0, p1, 0, 4, 2, 6);   // x0 x1 z0 z1
  const auto low23 = __builtin_shufflevector(p2, p3, 0, 4, 2, 6);   // x2 x3 z2 z3
  const auto high01 = __builtin_shufflevector(p0, p1, 1, 5, 3, 7);  // y0 y1 . .
  const auto high23 = __builtin_shufflevector(p2, p3, 1, 5, 3, 7);
  return {__builtin_shufflevector(low01, low23, 0, 1, 4, 5) - x[0],
          __builtin_shufflevector(high01, high23, 0, 1, 4, 5) - x[1],
          __builtin_shufflevector(low01, low23, 2, 3, 6, 7) - x[2]};
}
inline Corner<LanesOf<float>> corner(const float* values, size_t stride, const StarCell* c, int k,
                                     const double x[3]) {
  const auto at = [&](int i) { return values + c[i].t[k] * stride; };
  const auto p0 = pointsAt(at(0), at(4)), p1 = pointsAt(at(1), at(5)), p2 = pointsAt(at(2), at(6)),
             p3 = pointsAt(at(3), at(7));
  const auto xy01 = __builtin_shufflevector(p0, p1, 0, 8, 1, 9, 4, 12, 5, 13);  // x0 x1 y0 y1 x4 ..
  const auto xy23 = __builtin_shufflevector(p2, p3, 0, 8, 1, 9, 4, 12, 5, 13);
  const auto z01 = __builtin_shufflevector(p0, p1, 2, 10, 3, 11, 6, 14, 7, 15);  // z0 z1 . . z4 ..
  const auto z23 = __builtin_shufflevector(p2, p3, 2, 10, 3, 11, 6, 14, 7, 15);
  return {
      __builtin_shufflevector(xy01, xy23, 0, 1, 8, 9, 4, 5, 12, 13) - static_cast<float>(x[0]),
      __builtin_shufflevector(xy01, xy23, 2, 3, 10, 11, 6, 7, 14, 15) - static_cast<float>(x[1]),
      __builtin_shufflevector(z01, z23, 0, 1, 8, 9, 4, 5, 12, 13) - static_cast<float>(x[2])};
}

template <class L>
inline L squares(L a, L b, L c) {
  return a * a + b * b + c * c;
}

template <class S, class L>
inline Corner<L> scaledBy(S unit, const Corner<L>& c) {
  return {c.x * unit, c.y * unit, c.z * unit};
}

// Twice the area of a face as a vector, out of the cell.
template <class L>
inline Corner<L> normal(const Corner<L>& a, const Corner<L>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class L>
inline L inner(const Corner<L>& a, const Corner<L>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Whether the angle between two faces of squared areas a2, b2 is smaller.
template <class L>
inline auto anglesBelow(const Corner<L>& a, L a2, const Corner<L>& b, L b2, double cos2) {
  const L c = inner(a, b);
  return (c < 0) & (c * c > cos2 * (a2 * b2));
}

// Of the cells (0, p, q, r).
template <class L>
inline auto thinCells(const Corner<L>& p, const Corner<L>& q, const Corner<L>& r, double cos2) {
  const Corner<L> qp = {q.x - p.x, q.y - p.y, q.z - p.z}, rp = {r.x - p.x, r.y - p.y, r.z - p.z};
  const Corner<L> a = normal(q, p), b = normal(r, q), c = normal(p, r), d = normal(qp, rp);
  const L a2 = inner(a, a), b2 = inner(b, b), c2 = inner(c, c), d2 = inner(d, d);
  return anglesBelow(a, a2, b, b2, cos2) | anglesBelow(b, b2, c, c2, cos2) |
         anglesBelow(c, c2, a, a2, cos2) | anglesBelow(a, a2, d, d2, cos2) |
         anglesBelow(b, b2, d, d2, cos2) | anglesBelow(c, c2, d, d2, cos2);
}

// One bit per lane.
template <class M>
inline unsigned bitsOf(const M& mask) {
  constexpr unsigned kLanes = sizeof(M) / sizeof(mask[0]);
#ifdef __AVX2__
  if constexpr (kLanes == 4)
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
  else
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#else
  unsigned bits = 0;
  for (unsigned k = 0; k < kLanes; ++k) bits |= unsigned{mask[k] != 0} << k;
  return bits;
#endif
}

// Those of the lanes whose bits are set.
inline unsigned thinLanes(const Corner<LanesOf<double>>& p, const Corner<LanesOf<double>>& q,
                          const Corner<LanesOf<double>>& r, double cos2, unsigned lanes) {
  return bitsOf(thinCells(p, q, r, cos2)) & lanes;
}
// Angles need doubles: 1 - cos^2 of the smallest floor is no more than float32 resolves.
template <int first>
inline Corner<LanesOf<double>> halfOf(const Corner<LanesOf<float>>& c) {
  const auto half = [](LanesOf<float> v) {
    return __builtin_convertvector(
        __builtin_shufflevector(v, v, first, first + 1, first + 2, first + 3), LanesOf<double>);
  };
  return {half(c.x), half(c.y), half(c.z)};
}
inline unsigned thinLanes(const Corner<LanesOf<float>>& p, const Corner<LanesOf<float>>& q,
                          const Corner<LanesOf<float>>& r, double cos2, unsigned lanes) {
  return thinLanes(halfOf<0>(p), halfOf<0>(q), halfOf<0>(r), cos2, lanes & 15) |
         thinLanes(halfOf<4>(p), halfOf<4>(q), halfOf<4>(r), cos2, lanes >> 4) << 4;
}

// Those of the lanes below an angle, counted; all where there is no such angle.
template <class L>
inline unsigned countBelow(const Corner<L>& p, const Corner<L>& q, const Corner<L>& r, double cos2,
                           unsigned lanes, size_t& count) {
  if (lanes == 0 || !(cos2 < 1)) return lanes;
  const unsigned below = thinLanes(p, q, r, cos2, lanes);
  count += static_cast<size_t>(__builtin_popcount(below));
  return below;
}

// Counts the thin ones among the lanes, and returns their bits.
template <class L>
inline unsigned countThin(const Corner<L>& p, const Corner<L>& q, const Corner<L>& r,
                          const ThinAngle& thin, unsigned lanes, StarShape& shape) {
  const unsigned is_thin = thinLanes(p, q, r, thin.cos2, lanes);
  shape.thin += static_cast<size_t>(__builtin_popcount(is_thin));
  const unsigned in_middle = countBelow(p, q, r, thin.middle_cos2, is_thin, shape.middle);
  countBelow(p, q, r, thin.inner_cos2, in_middle, shape.inner);
  return is_thin;
}

// One cell that the filter could not decide, or of a size whose products it cannot hold.
template <class S>
inline bool carefully(const double x[3], const S* values, size_t stride, const StarCell& cell,
                      const ThinAngle& thin, StarShape& shape) {
  double t[3][3];
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) t[i][j] = static_cast<double>(values[cell.t[i] * stride + j]);
  if (orientation(x, t[0], t[1], t[2]) <= 0) return false;
  const double scale = 1 / largestDifference(x, t[0], t[1], t[2]);
  Corner<LanesOf<double>> c[3];
  for (int i = 0; i < 3; ++i)
    c[i] = {LanesOf<double>{} + (t[i][0] - x[0]) * scale,
            LanesOf<double>{} + (t[i][1] - x[1]) * scale,
            LanesOf<double>{} + (t[i][2] - x[2]) * scale};
  return !(countThin(c[0], c[1], c[2], thin, 1, shape) && thin.barred);
}

// As many cells as a vector has lanes, and the bits of those that were not met before.
struct CellLanes {
  const StarCell* cells;
  size_t begin;  // place of the first
  unsigned fresh;
};
// From `first` on; where too few are left some before them once more, or in a small star the last
// one repeated, in `room`.
template <size_t kLanes>
inline CellLanes lanesFrom(const StarCell* cells, size_t first, size_t count, StarCell* room) {
  constexpr unsigned kAll = (1u << kLanes) - 1;
  if (count - first >= kLanes) return {cells + first, first, kAll};
  if (count >= kLanes) {
    const size_t begin = count - kLanes;
    return {cells + begin, begin, kAll << (first - begin) & kAll};
  }
  for (size_t k = 0; k < kLanes; ++k) room[k] = cells[k < count ? k : count - 1];
  return {room, 0, (1u << count) - 1};
}

template <class S>
inline StarShape starShapeOf(const double x[3], const S* values, int stride_given, double scale,
                             const StarCell* cells, size_t count, const ThinAngle& thin) {
  using W = Wide<S>;
  using L = LanesOf<S>;
  const size_t stride = static_cast<size_t>(stride_given);
  const S unit = static_cast<S>(scale), shape = static_cast<S>(kRounding * thin.shape);
  StarShape found = {true, 0, 0, 0, 0};
  for (size_t first = 0; first < count; first += W::kLanes) {
    StarCell room[W::kLanes];
    const auto [c, begin, fresh] = lanesFrom<W::kLanes>(cells, first, count, room);
    const Corner<L> p = scaledBy(unit, corner(values, stride, c, 0, x)),
                    q = scaledBy(unit, corner(values, stride, c, 1, x)),
                    r = scaledBy(unit, corner(values, stride, c, 2, x));
    const L det = inner(p, normal(q, r));
    // Of all six edges, p and q and r and those between them.
    const L sum = 4 * (inner(p, p) + inner(q, q) + inner(r, r)) -
                  squares(p.x + q.x + r.x, p.y + q.y + r.y, p.z + q.z + r.z);
    const L det2 = det * det, sum3 = sum * sum * sum;
    const auto held = (sum > W::kLeastSum) & (sum < W::kLargestSum) & (det2 > W::kSure * sum3);
    if (const unsigned turned = bitsOf((det < 0) & held))
      return {false, 0, 0, 0, begin + static_cast<size_t>(__builtin_ctz(turned))};
    const auto sure = (det > 0) & held;
    const auto suspect = sure & (S(kRegular) * det2 < shape * sum3);
    if (const unsigned which = bitsOf(suspect) & fresh) {
      const unsigned is_thin = countThin(p, q, r, thin, which, found);
      if (is_thin && thin.barred)
        return {false, 0, 0, 0, begin + static_cast<size_t>(__builtin_ctz(is_thin))};
    }
    const unsigned unsure = ~bitsOf(sure) & fresh;
    for (size_t k = 0; unsure >> k; ++k)
      if ((unsure >> k & 1) && !carefully(x, values, stride, c[k], thin, found))
        return {false, 0, 0, 0, begin + k};
  }
  return found;
}

// With x as the origin, the coordinate of a corner is to the whole as the volume with x in its
// place.
template <class S>
inline NearestCell nearestCellOf(const double x[3], const S* values, int stride_given, double scale,
                                 uint32_t centre, const StarCell* cells, size_t count) {
  using W = Wide<S>;
  using L = LanesOf<S>;
  const size_t stride = static_cast<size_t>(stride_given);
  const S unit = static_cast<S>(scale);
  const S* at = values + centre * stride;
  const L none = L{};
  const Corner<L> o = {none + (at[0] - static_cast<S>(x[0])) * unit,
                       none + (at[1] - static_cast<S>(x[1])) * unit,
                       none + (at[2] - static_cast<S>(x[2])) * unit};
  NearestCell nearest = {0, -1e301};
  for (size_t first = 0; first < count; first += W::kLanes) {
    StarCell room[W::kLanes];
    const auto [c, begin, fresh] = lanesFrom<W::kLanes>(cells, first, count, room);
    const Corner<L> p = scaledBy(unit, corner(values, stride, c, 0, x)),
                    q = scaledBy(unit, corner(values, stride, c, 1, x)),
                    r = scaledBy(unit, corner(values, stride, c, 2, x));
    const Corner<L> qr = normal(q, r), rp = normal(r, p), pq = normal(p, q);
    const L part[4] = {inner(p, qr), -inner(o, qr), -inner(o, rp), -inner(o, pq)};
    const L whole = part[0] + part[1] + part[2] + part[3];
    L least = part[0] < part[1] ? part[0] : part[1];
    least = least < part[2] ? least : part[2];
    least = least < part[3] ? least : part[3];
    least = whole > none ? least / whole : none - S(1e30);
    for (size_t k = 0; fresh >> k; ++k)
      if ((fresh >> k & 1) && static_cast<double>(least[k]) > nearest.least)
        nearest = {begin + k, static_cast<double>(least[k])};
  }
  return nearest;
}

// ---------------------------------------------------------------------------------- gathering

#ifdef __AVX2__
// Of two cells of 8 bytes the places of t0, t1, t2, from byte 2 of each on, seen from a corner of
// each: one of four bits each, none for a cell that is dead.
struct LookTable {
  alignas(16) uint8_t places[0x89][16];
};
constexpr LookTable makeLookTable() {
  LookTable table{};
  for (unsigned bits = 0; bits < 0x89; ++bits)
    for (unsigned k = 0; k < 2; ++k) {
      uint8_t* const out = table.places[bits] + 8 * k;
      for (unsigned byte = 0; byte < 8; ++byte) out[byte] = 0x80;  // gives 0
      for (unsigned j = 0; j < 4; ++j)
        for (unsigned i = 0; (bits >> (4 * k + j) & 1) && i < 6; ++i)
          out[2 + i] = static_cast<uint8_t>(8 * k + 2u * kOpposite[j][i / 2] + i % 2);
    }
  return table;
}
constexpr LookTable kLook = makeLookTable();

// The places of the bits that are set, as pairs of 32-bit numbers of a vector and as pairs of
// bytes.
struct PickTable {
  alignas(32) uint32_t pairs[16][8];
  uint8_t bytes[16][8];
};
constexpr PickTable makePickTable() {
  PickTable table{};
  for (unsigned bits = 0; bits < 16; ++bits)
    for (unsigned k = 0, picked = 0; k < 4; ++k)
      for (unsigned i = 0; (bits >> k & 1) && i < 2; ++i, ++picked) {
        table.pairs[bits][picked] = 2 * k + i;
        table.bytes[bits][picked] = static_cast<uint8_t>(2 * k + i);
      }
  return table;
}
constexpr PickTable kPick = makePickTable();

inline uint64_t eightBytesAt(const uint16_t* p) {
  uint64_t bytes;
  __builtin_memcpy(&bytes, p, sizeof bytes);
  return bytes;
}
inline __m128i loadTwoCells(const uint16_t* corners, uint64_t two) {
  return _mm_set_epi64x(static_cast<int64_t>(eightBytesAt(corners + 4 * (two >> 16 & 0xffff))),
                        static_cast<int64_t>(eightBytesAt(corners + 4 * (two & 0xffff))));
}
inline __m128i eightBytes(const uint8_t* p) {
  return _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
}

// Of four cells, a number and three corners of 16 bits each, those whose bits are set.
inline void putCells(__m256i cells, unsigned bits, StarCell* out) {
  static_assert(sizeof(StarCell) == 16 && offsetof(StarCell, t) == 4);
  const __m256i places = _mm256_load_si256(reinterpret_cast<const __m256i*>(kPick.pairs[bits]));
  const __m256i picked = _mm256_permutevar8x32_epi32(cells, places);
  __m256i* const to = reinterpret_cast<__m256i*>(out);
  _mm256_storeu_si256(to, _mm256_cvtepu16_epi32(_mm256_castsi256_si128(picked)));
  _mm256_storeu_si256(to + 1, _mm256_cvtepu16_epi32(_mm256_extracti128_si256(picked, 1)));
}

inline unsigned zerosOf(__m256i masks) {
  const __m256i zeros = _mm256_cmpeq_epi64(masks, _mm256_setzero_si256());
  return static_cast<unsigned>(_mm256_movemask_pd(_mm256_castsi256_pd(zeros)));
}

// Four at a time, without branches, since there is no pattern in which of them are dead or have the
// other vertex: all are written, and what does not belong is overwritten by the next.
struct RoundLook {
  const uint16_t* corners;
  __m256i v, other;
  StarCell *star, *ring;

  // Of those whose bits are set in `there`. Returns the bits of those that live.
  unsigned lookAt(uint64_t four, unsigned there) {
    const __m256i corner =
        _mm256_set_m128i(loadTwoCells(corners, four >> 32), loadTwoCells(corners, four));
    const __m256i is_v = _mm256_cmpeq_epi16(corner, v),
                  is_other = _mm256_cmpeq_epi16(corner, other);
    const auto at = static_cast<unsigned>(  // four bits of a cell, two cells, each twice
        _mm256_movemask_epi8(_mm256_packs_epi16(is_v, is_v)));
    const __m256i look =
        _mm256_set_m128i(_mm_load_si128(reinterpret_cast<const __m128i*>(kLook.places[at >> 24])),
                         _mm_load_si128(reinterpret_cast<const __m128i*>(kLook.places[at & 0xff])));
    const __m128i numbers = _mm_cvtsi64_si128(static_cast<int64_t>(four));
    const __m256i seen =
        _mm256_or_si256(_mm256_shuffle_epi8(corner, look), _mm256_cvtepu16_epi64(numbers));
    const unsigned live = ~zerosOf(is_v) & there, alone = live & zerosOf(is_other);
    putCells(seen, alone, star);
    putCells(seen, live ^ alone, ring);
    star += __builtin_popcount(alone);
    ring += __builtin_popcount(live ^ alone);
    return live;
  }
};

inline StarCounts lookRoundOf(const uint16_t* corners, uint16_t* cells, uint32_t count, uint16_t v,
                              uint16_t other, StarCell* star, StarCell* ring) {
  RoundLook look = {corners, _mm256_set1_epi16(static_cast<short>(v)),
                    _mm256_set1_epi16(static_cast<short>(other)), star, ring};
  uint16_t* kept = cells;
  const uint16_t* const end = cells + count;
  for (; end - cells >= 4; cells += 4) {
    const uint64_t four = eightBytesAt(cells);
    const unsigned live = look.lookAt(four, 15);
    const __m128i numbers = _mm_cvtsi64_si128(static_cast<int64_t>(four));
    const __m128i first = _mm_shuffle_epi8(numbers, eightBytes(kPick.bytes[live]));
    _mm_storel_epi64(reinterpret_cast<__m128i*>(kept), first);
    kept += __builtin_popcount(live);
  }
  if (const auto left = static_cast<unsigned>(end - cells)) {
    uint64_t four = 0;
    for (unsigned k = 0; k < left; ++k) four |= uint64_t{cells[k]} << 16 * k;
    for (unsigned k = 0, live = look.lookAt(four, (1u << left) - 1); k < left; ++k) {
      *kept = cells[k];
      kept += live >> k & 1;
    }
  }
  return {static_cast<uint32_t>(look.star - star), static_cast<uint32_t>(look.ring - ring)};
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
    out.cell = cell;
    for (int k = 0; k < 3; ++k) out.t[k] = corner[kOpposite[j][k]];
  }
  return {kept, in_ring};
}
#endif

// ---------------------------------------------------------------------------------- links

typedef uint32_t Numbers __attribute__((vector_size(32)));  // of four corners two each

// One to one, looks random (each of the two numbers with factors of its own).
inline Numbers mixed(Numbers n) {
  constexpr Numbers kFirst = {0x7feb352d, 0x21f0aaad, 0x7feb352d, 0x21f0aaad,
                              0x7feb352d, 0x21f0aaad, 0x7feb352d, 0x21f0aaad};
  constexpr Numbers kSecond = {0x846ca68b, 0xd35a2d97, 0x846ca68b, 0xd35a2d97,
                               0x846ca68b, 0xd35a2d97, 0x846ca68b, 0xd35a2d97};
  n = (n ^ (n >> 16)) * kFirst;
  n = (n ^ (n >> 15)) * kSecond;
  return n ^ (n >> 16);
}
typedef uint32_t NumberPair __attribute__((vector_size(8)));
inline void addPair(NumberPair pair, uint64_t* sums) {
  NumberPair before;
  __builtin_memcpy(&before, sums, sizeof before);
  before += pair;
  __builtin_memcpy(sums, &before, sizeof before);
}
// Of corners a, b, c of each face: j's is that of kOpposite[j].
inline Numbers cornersA(Numbers n) {
  return __builtin_shufflevector(n, n, 2, 3, 0, 1, 0, 1, 0, 1);
}
inline Numbers cornersB(Numbers n) {
  return __builtin_shufflevector(n, n, 4, 5, 6, 7, 2, 3, 4, 5);
}
inline Numbers cornersC(Numbers n) {
  return __builtin_shufflevector(n, n, 6, 7, 4, 5, 6, 7, 2, 3);
}

inline void addToLinkSumsOf(const uint32_t v[4], bool negative, const uint32_t taken[4],
                            uint64_t* sums) {
  static_assert(kOpposite[0][0] == 1 && kOpposite[1][0] == 0 && kOpposite[1][1] == 3 &&
                kOpposite[2][1] == 1 && kOpposite[3][1] == 2);
  const Numbers x = mixed(Numbers{v[0], v[0], v[1], v[1], v[2], v[2], v[3], v[3]} + 0x9e3779b9u);
  const Numbers y = (x ^ (x >> 13)) * 0xde82ef95u;
  const Numbers xa = cornersA(x), ya = cornersA(y);
  const Numbers bx = cornersB(x) - xa, by = cornersB(y) - ya;
  const Numbers cx = cornersC(x) - xa, cy = cornersC(y) - ya;
  const Numbers sign = Numbers{} - uint32_t{negative};
  const Numbers all = {taken[0], taken[0], taken[1], taken[1],
                       taken[2], taken[2], taken[3], taken[3]};
  const Numbers added = (((bx * cy - cx * by) ^ sign) - sign) & all;
  addPair(__builtin_shufflevector(added, added, 0, 1), sums + v[0]);
  addPair(__builtin_shufflevector(added, added, 2, 3), sums + v[1]);
  addPair(__builtin_shufflevector(added, added, 4, 5), sums + v[2]);
  addPair(__builtin_shufflevector(added, added, 6, 7), sums + v[3]);
}

// Without branches, since there is no pattern in what was seen before.
inline void listVertex(uint32_t v, uint32_t* seen, uint32_t mark, uint32_t* out, size_t* listed) {
  out[*listed] = v;
  *listed += seen[v] < mark;
  seen[v] = seen[v] < mark ? mark : seen[v];
}
inline size_t listVerticesOf(const uint16_t* corners, const uint16_t* cells, uint32_t count,
                             uint32_t* seen, uint32_t mark, uint32_t* out) {
  size_t listed = 0;
  for (uint32_t i = 0; i < count; ++i)
    for (size_t k = 0; k < 4; ++k)
      listVertex(corners[4 * size_t{cells[i]} + k], seen, mark, out, &listed);
  return listed;
}
inline size_t listVerticesOf(const StarCell* cells, size_t count, uint32_t* seen, uint32_t mark,
                             uint32_t* out) {
  size_t listed = 0;
  for (size_t i = 0; i < count; ++i)
    for (uint32_t t : cells[i].t) listVertex(t, seen, mark, out, &listed);
  return listed;
}

}  // namespace
}  // namespace tetstream
