// mesh: the bodies of the star kernels, compiled once per instruction set. Plain arithmetic in a
// fixed order, no contraction: the same answers from every build.
#include "orient.h"
#include "star_kernels.h"
#include "wide.h"
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
    return toDoubles(__builtin_shufflevector(v, v, first, first + 1, first + 2, first + 3));
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

}  // namespace
}  // namespace tetstream
