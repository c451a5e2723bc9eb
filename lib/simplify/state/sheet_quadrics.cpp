#include "sheet_quadrics.h"

#include <cmath>

#include "vector3.h"

namespace tetstream {

template <class S>
static double weightOf(const Core<S>& core, SheetFace kind) {
  const bool is_dear =
      kind == SheetFace::kInner || (kind == SheetFace::kInterface && core.plan.dimension > 3);
  const double balance = kind == SheetFace::kOuter ? core.balance.outer
                         : kind == SheetFace::kInterface
                             ? core.balance.outer * core.balance.interfaces
                             : 1;
  return (is_dear ? kInterfaceShare : 1) * balance * core.face_weight;
}

// Where the field is steep across the boundary, as in the layer at a heated wall, what comes to lie
// outside has most of the error: as much as the field's own quadric has there keeps it in. (Within
// a factor of 4 the errors are the same; nearly flat fields lose nothing.)
constexpr double kSlopeBeyond = 1;

template <class S>
void addFaceQuadric(const Core<S>& core, const S* const x[3], SheetFace kind, S* const q[3]) {
  const bool has_beyond = kind == SheetFace::kOuter && !followsPaper(core.options.mode);
  core.kernels.addFace(x, core.scale.data(), core.plan.dimension, weightOf(core, kind),
                       has_beyond ? kSlopeBeyond : 0, q);
}

template <class S>
void addFaceShape(const Core<S>& core, const S* const x[3], SheetFace kind, S* const q[3]) {
  core.kernels.addFace(x, core.scale.data(), core.plan.dimension, weightOf(core, kind), 0, q);
}

// The squared distance to the line of the edge, with the weight of two faces that are squares on
// it: their planes meet there at a right angle.
template <class S>
void addCurveQuadric(const Core<S>& core, const S* const x[2], bool inner, S* const q[2]) {
  const S *const a = x[0], *const b = x[1];
  double along[3], square = 0;
  for (size_t i = 0; i < 3; ++i) {
    along[i] = static_cast<double>(b[i]) - static_cast<double>(a[i]);
    square += along[i] * along[i];
  }
  if (!(square > 0)) return;
  // Across the edge and the axis that it is farthest from.
  size_t axis = 0;
  for (size_t i = 1; i < 3; ++i)
    if (std::fabs(along[i]) < std::fabs(along[axis])) axis = i;
  const double length = std::sqrt(square);
  double across[2][3];
  double unit[3] = {0, 0, 0};
  unit[axis] = 1;
  cross(along, unit, across[0]);
  cross(along, across[0], across[1]);
  S tip[kMaxDimension];
  S nowhere[quadricSize(QuadricLayout::kFields, kMaxDimension)] = {};
  std::copy_n(b, core.plan.dimension, tip);
  // note: of a full quadric the part in space comes first, too.
  const auto& plane = quadricKernels<S>(QuadricLayout::kFields, core.plan.dimension);
  for (const double* direction : {across[0], across[1]}) {
    const double norm = std::sqrt(direction[0] * direction[0] + direction[1] * direction[1] +
                                  direction[2] * direction[2]);
    for (size_t i = 0; i < 3; ++i)
      tip[i] = static_cast<S>(static_cast<double>(b[i]) + direction[i] * (length / norm));
    const S* face[3] = {a, b, tip};
    S* rows[3] = {q[0], q[1], nowhere};
    plane.addFace(face, core.scale.data(), core.plan.dimension,
                  weightOf(core, inner ? SheetFace::kInner : SheetFace::kOuter), 0, rows);
  }
}

template void addFaceQuadric(const Core<float>&, const float* const[3], SheetFace, float* const[3]);
template void addFaceQuadric(const Core<double>&, const double* const[3], SheetFace,
                             double* const[3]);
template void addFaceShape(const Core<float>&, const float* const[3], SheetFace, float* const[3]);
template void addFaceShape(const Core<double>&, const double* const[3], SheetFace,
                           double* const[3]);
template void addCurveQuadric(const Core<float>&, const float* const[2], bool, float* const[2]);
template void addCurveQuadric(const Core<double>&, const double* const[2], bool, double* const[2]);

}  // namespace tetstream
