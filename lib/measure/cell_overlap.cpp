#include "cell_overlap.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "vector3.h"

namespace tetstream {

// The six products that a determinant is the signed sum of, all positive: what its rounding is
// relative to. Of a cell that is thin along an axis they are not much more than its volume.
static double sumOfProducts(const double* corners) {
  double e[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) e[i][k] = std::fabs(corners[3 * (i + 1) + k] - corners[k]);
  const auto pair = [&](int j, int k) { return e[1][j] * e[2][k] + e[1][k] * e[2][j]; };
  return e[0][0] * pair(1, 2) + e[0][1] * pair(0, 2) + e[0][2] * pair(0, 1);
}

bool CellMap::set(const double* corners) {
  return std::fabs(frame_.set(corners)) > kFlat * sumOfProducts(corners);
}

static const double kWhole[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

bool CellOverlap::set(const double planes[4][4]) {
  volume = 0;
  pieces = 0;
  std::fill_n(moments, 10, 0.0);
  cut(kWhole, planes, 0);
  return pieces > 0;
}

// Where the edge from a corner inside to one outside meets the plane.
static void meet(const double inside[4], double in, const double outside[4], double out,
                 double place[4]) {
  const double share = in / (in - out);
  for (int k = 0; k < 4; ++k) place[k] = inside[k] + share * (outside[k] - inside[k]);
}

// The part of a piece on the inner side of the planes from `plane` on.
void CellOverlap::cut(const double v[4][4], const double planes[4][4], int plane) {
  double h[4];
  int in[4], out[4], inside = 0, outside = 0;
  for (; plane < 4; ++plane) {
    const double* p = planes[plane];
    inside = outside = 0;
    for (int i = 0; i < 4; ++i) {
      h[i] = p[0] * v[i][0] + p[1] * v[i][1] + p[2] * v[i][2] + p[3] * v[i][3];
      if (h[i] > 0)
        in[inside++] = i;
      else if (h[i] < 0)
        out[outside++] = i;
    }
    if (inside == 0) return;
    if (outside > 0) break;
  }
  if (plane == 4) return keep(v);
  // A corner on the plane counts as inside: its cut is where it is.
  for (int i = 0; i < 4; ++i)
    if (h[i] == 0) in[inside++] = i;
  const auto at = [&](int i, int o, double place[4]) { meet(v[i], h[i], v[o], h[o], place); };
  double part[4][4];
  if (inside == 1) {
    std::copy_n(v[in[0]], 4, part[0]);
    for (int j = 0; j < 3; ++j) at(in[0], out[j], part[j + 1]);
    return cut(part, planes, plane + 1);
  }
  // A prism, from triangle `low` to triangle `high`, as three tetrahedra.
  double prism[6][4];
  if (inside == 2) {
    for (int j = 0; j < 2; ++j) {
      std::copy_n(v[in[j]], 4, prism[3 * j]);
      at(in[j], out[0], prism[3 * j + 1]);
      at(in[j], out[1], prism[3 * j + 2]);
    }
  } else {
    for (int j = 0; j < 3; ++j) {
      std::copy_n(v[in[j]], 4, prism[j]);
      at(in[j], out[0], prism[j + 3]);
    }
  }
  for (int j = 0; j < 3; ++j) cut(prism + j, planes, plane + 1);
}

void CellOverlap::keep(const double v[4][4]) {
  double e[3][3];
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) e[i][k] = v[i + 1][k + 1] - v[0][k + 1];
  const double w = std::fabs(determinant(e[0], e[1], e[2]));
  if (!(w > 0)) return;
  volume += w;
  static constexpr int kRows[10] = {0, 1, 2, 3, 0, 0, 0, 1, 1, 2};
  static constexpr int kColumns[10] = {0, 1, 2, 3, 1, 2, 3, 2, 3, 3};
  double s[4];
  for (int k = 0; k < 4; ++k) s[k] = v[0][k] + v[1][k] + v[2][k] + v[3][k];
  for (int m = 0; m < 10; ++m) {
    const int p = kRows[m], q = kColumns[m];
    moments[m] += w / 20 *
                  (s[p] * s[q] + v[0][p] * v[0][q] + v[1][p] * v[1][q] + v[2][p] * v[2][q] +
                   v[3][p] * v[3][q]);
  }
  std::memcpy(piece[pieces++], v, sizeof piece[0]);
}

double CellOverlap::integralOfSquare(const double d[4]) const {
  const double* m = moments;
  const double squares =
      m[0] * d[0] * d[0] + m[1] * d[1] * d[1] + m[2] * d[2] * d[2] + m[3] * d[3] * d[3];
  const double products = d[0] * (m[4] * d[1] + m[5] * d[2] + m[6] * d[3]) +
                          d[1] * (m[7] * d[2] + m[8] * d[3]) + m[9] * d[2] * d[3];
  return std::max(squares + 2 * products, 0.0);  // rounding alone could make it negative
}

}  // namespace tetstream
