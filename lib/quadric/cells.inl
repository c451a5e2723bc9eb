// quadric: the field errors of cells and the planes of faces, in the layout kFields. Part of
// kernels.inl.
#pragma once

#include "layouts.inl"

namespace tetstream {
namespace {

inline double squareRoot(double v) {
  return __builtin_sqrt(v);
}

// b - a in normalised units.
template <class S>
inline void difference(const S* a, const S* b, const S* scale, int n, double* out) {
  for (int i = 0; i < n; ++i)
    out[i] = static_cast<double>(b[i] - a[i]) * static_cast<double>(scale[i]);
}

template <class V>
[[gnu::always_inline]] inline void cross(const V* a, const V* b, V* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

template <class V>
[[gnu::always_inline]] inline V dot(const V* a, const V* b, int n) {
  V sum = V{};
  for (int i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

template <class V>
[[gnu::always_inline]] inline V squaredSize(const V* e1, const V* e2, const V* e3) {
  return dot(e1, e1, 3) + dot(e2, e2, 3) + dot(e3, e3, 3);
}

// 6 V, raised for near-flat cells.
inline double effectiveVolume(const double* e1, const double* e2, const double* e3, double det) {
  const double size = squaredSize(e1, e2, e3);
  const double least = kFlatVolume * size * squareRoot(size);
  const double volume = det < 0 ? -det : det;
  return volume > least ? volume : least;
}

template <class S>
inline void addToAll(const double* a, int size, S* const* q, int count) {
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < size; ++i) q[k][i] += static_cast<S>(a[i]);
}

// A cell (V is double) or four (V is a vector): the same operations in the same order.
template <class V, int N>
struct CellField {
  V e1[kRoom<N>], e2[kRoom<N>], e3[kRoom<N>];  // the edges from the first corner
  V c1[3], c2[3], c3[3];
  V a[Fields::size(kRoom<N>)];

  V determinant() {
    cross(e2, e3, c1);
    cross(e3, e1, c2);
    cross(e1, e2, c3);
    return dot(e1, c1, 3);
  }
  // `volume`: the effective one.
  void form(int n, double shape, V det, V volume) {
    const V w = 1.0 / (24.0 * volume);  // a quarter of 1 / (6 * 6V) times n n^T
    for (int i = 0; i < 6; ++i) a[i] = V{};
    for (int f = 3; f < n; ++f) {
      V g[3];  // det times the gradient of component f
      for (int i = 0; i < 3; ++i) g[i] = e1[f] * c1[i] + e2[f] * c2[i] + e3[f] * c3[i];
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) a[at(i, j)] += w * (g[i] * g[j]);
        a[Fields::gradient(f) + i] = -(w * (g[i] * det));
      }
    }
    if (n > 3) a[Fields::weight(n)] = w * (det * det);
    for (int i = 0; i < 3; ++i) a[at(i, i)] += shape * volume / 24.0;
  }
};

template <class S, int N>
double addCellField(const S* const x[4], const S* scale, int n_given, double shape, S* const q[4]) {
  const int n = dimension<N>(n_given);
  CellField<double, N> cell;
  difference(x[0], x[1], scale, n, cell.e1);
  difference(x[0], x[2], scale, n, cell.e2);
  difference(x[0], x[3], scale, n, cell.e3);
  const double det = cell.determinant();
  cell.form(n, shape, det, effectiveVolume(cell.e1, cell.e2, cell.e3, det));
  addToAll(cell.a, Fields::size(n) - 1, q, 4);
  return det;
}

// Of a quadric: its mean gradient's part along c, squared and summed over components, times W.
template <class S>
inline double slopeAlong(const double* c, int n, const S* q) {
  const double volume = n > 3 ? static_cast<double>(q[Fields::weight(n)]) : 0;
  if (!(volume > 0)) return 0;
  double sum = 0;
  for (int f = 3; f < n; ++f) {
    double along = 0;
    for (int j = 0; j < 3; ++j) along += c[j] * static_cast<double>(q[Fields::gradient(f) + j]);
    sum += along * along;
  }
  return sum / volume;
}

// The plane is in space: the first six numbers of the triangle.
template <class S, int N>
void addFacePlane(const S* const x[3], const S* scale, int n_given, double weight, double slope,
                  S* const q[3]) {
  const int n = dimension<N>(n_given);
  double e1[3], e2[3], c[3], a[6];
  difference(x[0], x[1], scale, 3, e1);
  difference(x[0], x[2], scale, 3, e2);
  cross(e1, e2, c);
  const double c2 = dot(c, c, 3);
  if (!(c2 > 0)) return;
  const double area = 0.5 * squareRoot(c2);
  for (int k = 0; k < 3; ++k) {
    const double beyond = slope > 0 ? slope * slopeAlong(c, n, q[k]) / c2 : 0;
    const double w = (weight * area + beyond) / 3.0 / c2;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j) a[at(i, j)] = w * (c[i] * c[j]);
    addToAll(a, 6, q + k, 1);
  }
}

// ----------------------------------------------------------------- four cells side by side
static_assert(kCellLanes == 4);
// Above it neither the effective volume nor, for edges rounded to float32, the sign is in doubt.
constexpr double kSureVolume = kFlatVolume * (1 + 1e-6);

// The values of corner j of four cells, as columns.
template <class S>
inline void loadCorner(const VertexTable<S>& table, const uint32_t* corners, int j, int n,
                       typename Lanes<S>::Four* columns) {
  for (int first = 0; first < n; first += 4) {
    for (int k = 0; k < 4; ++k)
      __builtin_memcpy(&columns[first + k], table.value(corners[4 * k + j]) + first,
                       sizeof columns[0]);
    transpose(columns + first);
  }
}

// One cell after the other, as it would be alone: they share vertices.
template <class S, int N>
inline void addToCorners(const Double4* a, size_t stride, const uint32_t* rows_of, int n,
                         S* quadrics) {
  using Four = typename Lanes<S>::Four;
  // Behind the numbers of a cell each row has the error, to which 0 may be added.
  const int size = Fields::size(n) - 1, fours = (size + 3) / 4, whole = (size + 1) / 4;
  Four rows[kQuadricRoom<Fields, N> / 4][4];
  for (int b = 0; b < fours; ++b) {
    for (int k = 0; k < 4; ++k)
      rows[b][k] = 4 * b + k < size ? __builtin_convertvector(a[4 * b + k], Four) : Four{};
    transpose(rows[b]);
  }
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      S* q = quadrics + rows_of[4 * k + j] * stride;
      for (int b = 0; b < whole; ++b) {
        Four sum;
        __builtin_memcpy(&sum, q + 4 * b, sizeof sum);
        sum += rows[b][k];
        __builtin_memcpy(q + 4 * b, &sum, sizeof sum);
      }
      for (int i = 4 * whole; i < size; ++i) q[i] += rows[i / 4][k][i % 4];
    }
}

template <class S, int N>
bool addCellFields(const VertexTable<S>& table, S* quadrics, const uint32_t* corners,
                   const uint32_t* rows, const S* scale, int n_given, double shape,
                   double* determinants) {
  using Four = typename Lanes<S>::Four;
  const int n = dimension<N>(n_given);
  CellField<Double4, N> cells;
  Four origin[kValueRoom<N>], end[kValueRoom<N>];
  loadCorner(table, corners, 0, n, origin);
  Double4* const edges[3] = {cells.e1, cells.e2, cells.e3};
  for (int j = 0; j < 3; ++j) {
    loadCorner(table, corners, j + 1, n, end);
    for (int i = 0; i < n; ++i)
      edges[j][i] = toDoubles(end[i] - origin[i]) * static_cast<double>(scale[i]);
  }
  const Double4 det = cells.determinant();
  const Double4 size = squaredSize(cells.e1, cells.e2, cells.e3);
  const auto sure = det * det > kSureVolume * kSureVolume * (size * size * size);
  if (!(sure[0] & sure[1] & sure[2] & sure[3])) return false;
  cells.form(n, shape, det, det < 0 ? -det : det);
  addToCorners<S, N>(cells.a, static_cast<size_t>(table.quadric_stride), rows, n, quadrics);
  for (int k = 0; k < 4; ++k) determinants[k] = det[k];
  return true;
}

}  // namespace
}  // namespace tetstream
