// mesh: the body of the thinness of several cells, compiled once per instruction set. What
// thinness.cpp does to one cell is done here in the same order, without contraction: the same
// numbers from every build.
#include "orient.h"
#include "thinness.h"
#include "wide.h"

namespace tetstream {
namespace {

// One number of each cell.
using CellLanes = FourDoubles;
static_assert(sizeof(CellLanes) == kThinLanes * sizeof(double));
struct VectorLanes {
  CellLanes x, y, z;
};

// The fourth number is anything.
template <class S>
inline CellLanes rowAt(const S* p) {
  typedef S Row __attribute__((vector_size(kThinLanes * sizeof(S))));
  Row row;
  __builtin_memcpy(&row, p, sizeof row);
  return toDoubles(row);
}

// Of each cell its corner k.
template <class S>
inline VectorLanes cornersAt(const S* values, size_t stride, const uint32_t (*corners)[4], int k) {
  const CellLanes p0 = rowAt(values + corners[0][k] * stride),
                  p1 = rowAt(values + corners[1][k] * stride),
                  p2 = rowAt(values + corners[2][k] * stride),
                  p3 = rowAt(values + corners[3][k] * stride);
  const CellLanes xz01 = __builtin_shufflevector(p0, p1, 0, 4, 2, 6);
  const CellLanes xz23 = __builtin_shufflevector(p2, p3, 0, 4, 2, 6);
  const CellLanes y01 = __builtin_shufflevector(p0, p1, 1, 5, 3, 7);
  const CellLanes y23 = __builtin_shufflevector(p2, p3, 1, 5, 3, 7);
  return {__builtin_shufflevector(xz01, xz23, 0, 1, 4, 5),
          __builtin_shufflevector(y01, y23, 0, 1, 4, 5),
          __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7)};
}

inline VectorLanes operator-(const VectorLanes& a, const VectorLanes& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline CellLanes dotOf(const VectorLanes& a, const VectorLanes& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline VectorLanes crossOf(const VectorLanes& a, const VectorLanes& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline auto allZero(const CellLanes& a, const CellLanes& b, const CellLanes& c) {
  return (a == 0) & (b == 0) & (c == 0);
}

template <class S>
inline void thinnessOfFourOf(const S* values, int stride_given, const uint32_t (*corners)[4],
                             double* out) {
  const auto stride = static_cast<size_t>(stride_given);
  const VectorLanes p = cornersAt(values, stride, corners, 0);
  const VectorLanes e[3] = {cornersAt(values, stride, corners, 1) - p,
                            cornersAt(values, stride, corners, 2) - p,
                            cornersAt(values, stride, corners, 3) - p};
  const CellLanes sum = dotOf(e[0], e[0]) + dotOf(e[1], e[1]) + dotOf(e[2], e[2]);
  const VectorLanes n[4] = {crossOf(e[1] - e[0], e[2] - e[0]), crossOf(e[2], e[1]),
                            crossOf(e[0], e[2]), crossOf(e[1], e[0])};
  const CellLanes six = -dotOf(e[0], n[1]);
  // In a plane across an axis, as corners on the side of a box, they make no volume: six is 0.
  const auto is_sure = ((sum > kLeastThinSum) & (sum < kLargestThinSum) &
                        (six * six > kSureVolume * (sum * sum * sum))) |
                       allZero(e[0].x, e[1].x, e[2].x) | allZero(e[0].y, e[1].y, e[2].y) |
                       allZero(e[0].z, e[1].z, e[2].z);
  const CellLanes n2[4] = {dotOf(n[0], n[0]), dotOf(n[1], n[1]), dotOf(n[2], n[2]),
                           dotOf(n[3], n[3])};
  CellLanes worst = CellLanes{} - 1;
  auto is_flat = worst > 0;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < k; ++l) {
      const CellLanes c = dotOf(n[k], n[l]), size = n2[k] * n2[l];
      const CellLanes cos2 = (c < 0 ? c : -c) * c / size;
      is_flat |= ~(size > 0);
      worst = worst < cos2 ? cos2 : worst;
    }
  worst = is_flat ? CellLanes{} + 1 : worst;
  worst = six > 0 ? worst : CellLanes{} + kTurned;
  for (size_t i = 0; i < kThinLanes; ++i) {
    out[i] = worst[i];
    if (is_sure[i]) continue;
    double t[4][3];
    for (size_t k = 0; k < 4; ++k)
      for (size_t j = 0; j < 3; ++j)
        t[k][j] = static_cast<double>(values[corners[i][k] * stride + j]);
    out[i] = thinness(t);
  }
}

}  // namespace
}  // namespace tetstream
