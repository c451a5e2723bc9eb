// quadric: generalised quadrics in R^n, n = 3 + measured field components, and the minimizer of an
// edge. Arithmetic only: nothing is allocated, nothing called. Depends on nothing.
//
// A quadric is kept as (A, p, e): Q(x) = (x - p)^T A (x - p) + e with its minimum e at p (Vo et al.
// 2007, section 3.4): no large numbers cancel near the minimum, and e1 + e2 bounds the error of a
// merge from below without a solve. p is the vertex itself, position and fields, in the user's
// units. A and e are in normalised units: component i of a difference is multiplied by scale[i].
// In memory A comes first, in one of two layouts, then e.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tetstream {

// With f a component's row behind the three of space,
//   A = [ C   G ]   kFields: the form whose normals are not normalised leaves this of it, after
//       [ G^T W ]   sums, too (Hoppe 1999): W is a number times the identity, the sum of the
//       weights
// of the cells, and stands for every component alike, since what a component counts is in its
// scale. Kept are C's lower triangle by rows, the three numbers of G of each component, and W,
// where there is a component.
//   kFull: the lower triangle by rows, n (n + 1) / 2 numbers.
enum class QuadricLayout { kFields, kFull };

constexpr int quadricSize(QuadricLayout layout, int n) {
  if (layout == QuadricLayout::kFull) return n * (n + 1) / 2 + 1;
  return 6 + 3 * (n - 3) + (n > 3 ? 1 : 0) + 1;
}
constexpr int kMaxDimension = 128;  // 3 + measured components: bounds the kernels' local arrays

// Weights of the shape regulariser, 1/unit^0: each cell adds weight V |x - p|^2 in space. It keeps
// flat and linear fields from making every position equally good, which locks a run. In smooth
// fields 1e-4 already drowns the error of the field itself; conjugate gradients, which drop what
// is below 1 / kMaxCondition, need it.
constexpr double kShapeWeight = 1e-6, kShapeWeightPaper = 1e-4;

// The direct solve adds this share of a quadric's trace in space to its diagonal there: what the
// quadric does not determine stays near the midpoint, and rounding in float32 counts as nothing.
constexpr double kSolveWeight = 1e-6;
// CG drops directions whose curvature is below mean eigenvalue / kMaxCondition.
constexpr double kMaxCondition = 1e4;
// A cell is treated as if it had at least this volume, times 6, of the cube of its edges' norm:
// gradients of near-flat cells mean nothing and would freeze their vertices.
constexpr double kFlatVolume = 1e-5;

// Edges that are minimized, and cells that are measured, at once.
constexpr int kEdgeLanes = 8, kCellLanes = 4;

// Quadrics and values of many vertices, by slot. Three numbers beyond the last of each must be
// readable: rows are read four numbers at a time.
template <class S>
struct VertexTable {
  const S* quadrics;
  const S* values;
  int quadric_stride, value_stride;
  const S* quadric(uint32_t v) const { return quadrics + size_t{v} * size_t(quadric_stride); }
  const S* value(uint32_t v) const { return values + size_t{v} * size_t(value_stride); }
};

// One entry per layout and dimension, chosen once per run.
template <class S>
struct QuadricKernels {
  // Adds the quadric of a cell, a quarter of it to each of its vertices.
  //   kFields: the integral of the squared field error, sum over components c of
  //     V (g_c, -1)(g_c, -1)^T with g_c the cell's gradient: n n^T / V with n the determinant of
  //     the edges (section 3.4).
  //   kFull: the squared distance to the cell's hyperplane, V (I - sum of e_i e_i^T) over an
  //     orthonormal basis of the cell in R^n (Garland and Zhou 2005).
  // `shape`: kShapeWeight, or another weight of the regulariser. Returns 6 V, with its sign.
  double (*addCell)(const S* const x[4], const S* scale, int n, double shape, S* const q[4]);
  // The same numbers for kCellLanes cells, one after the other: their corners, four to a cell, and
  // for each the row of `quadrics` to add to; 6 V of each cell. False, and nothing is done, where
  // one is too flat for its sign to be sure, and for kFull.
  bool (*addCells)(const VertexTable<S>& table, S* quadrics, const uint32_t* corners,
                   const uint32_t* rows, const S* scale, int n, double shape, double* determinants);
  // Adds a boundary face to its vertices: weight * area / 3 times the squared distance to
  // its plane in space (kFields), or to its 2-flat in R^n (kFull).
  // `slope` (kFields): of a vertex, slope * W g^2 / 3 times it besides, with W and the mean
  // gradient of what its quadric has from cells, and g the gradient's part across the face: where
  // the boundary moves, a layer of the field comes to lie outside, or is made up.
  void (*addFace)(const S* const x[3], const S* scale, int n, double weight, double slope,
                  S* const q[3]);
  // Carries a quadric over into units in which component i is divided by factor[i], and multiplies
  // it by `weight`. kFields: W is that of the component with the smallest factor; of the others,
  // which would count more, what belongs to their mean gradients is brought down to it.
  void (*rescale)(const S* factor, S weight, int n, S* q);
  // Minimizes Q1 + Q2 by conjugate gradients from the midpoint m: z = scale (x - m). Returns the
  // error there, not less than e1 + e2; not finite if the arithmetic overflowed.
  S(*minimizeEdge)
  (const S* q1, const S* x1, const S* q2, const S* x2, const S* scale, int n, S* z);
  // The same by elimination, fields first (their pivot is a volume, never small), regularised by
  // kSolveWeight: without branches, so that many edges are solved side by side. kFields: linear in
  // the number of components, since they meet in space only (Hoppe and Marschner 2000).
  S(*solveEdge)
  (const S* q1, const S* x1, const S* q2, const S* x2, const S* scale, int n, S* z);
  // The same numbers for 1 to kEdgeLanes edges, given by their two ends each: n numbers of z and an
  // error to an edge.
  void (*solveEdges)(const VertexTable<S>& table, const uint32_t* ends, int count, const S* scale,
                     int n, S* z, S* errors);
  // The errors of solveEdge from vertex u to each of `count` others, which rank them: computed in
  // float32 from differences in S, so that those of S = float are the same numbers. `errors` has
  // room for a multiple of kEdgeLanes.
  void (*edgeErrors)(const VertexTable<S>& table, uint32_t u, const uint32_t* others, int count,
                     const S* scale, int n, S* errors);
  // The error of Q1 + Q2 at a given z.
  S(*errorAt)
  (const S* q1, const S* x1, const S* q2, const S* x2, const S* scale, int n, const S* z);
  // The fields of z, where Q1 + Q2 is least for them, go along with a step of z in space to where
  // it is again. kFull: they stay.
  void (*followStep)(const S* q1, const S* q2, int n, const S* step, S* z);
  // What of Q1 + Q2 is left in space where the fields follow: the lower triangle by rows.
  void (*spaceForm)(const S* q1, const S* q2, int n, S* form);
};

// The kernels for a layout and dimension n, built for this processor; every build gives the same
// numbers.
template <class S>
const QuadricKernels<S>& quadricKernels(QuadricLayout layout, int n);

// "x86-64-v3" or "plain": which build quadricKernels gives here.
const char* kernelBuild();

}  // namespace tetstream
