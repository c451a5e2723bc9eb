// measure: what two cells have in common, and integrals over it: arithmetic only. Depends on
// barycentric.h.
//
// All is told in the barycentric coordinates l0..l3 of the first cell, a: each plane of the other
// one, b, is a linear function of them, given by its values at a's corners. Cutting a by these
// planes one after the other leaves pieces, each a tetrahedron. With s the sum of a piece's corners
// v0..v3 and w its share of a's volume,
//     integral of l_p l_q over it  =  w / 20 (s_p s_q + sum_i v_ip v_iq)     (times a's volume),
// so that a function that is linear on a, with values d_p at its corners, has the integral of its
// square  sum_pq M_pq d_p d_q  over the common part; M is the sum over the pieces.
#pragma once

#include <cstddef>

#include "barycentric.h"

namespace tetstream {

// A place is in a cell whose barycentric coordinates there are not below this, as for the
// independent judge.
constexpr double kInside = -1e-9;

// From places to the barycentric coordinates of a cell.
class CellMap {
 public:
  // False if the cell is too flat to have any: its volume is below kFlat of the products of which
  // it is the sum, so mostly their rounding.
  bool set(const double* corners);  // [4][3]
  void coordinates(const double place[3], double out[4]) const { frame_.weights(place, out); }
  // planes[k][j]: coordinate k of corner j of another cell. False, and not all is told, if the cell
  // lies beyond one of the faces.
  bool planesOf(const double* corners, double planes[4][4]) const {
    double d[3][4];
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 3; ++k) d[k][j] = corners[3 * j + k] - frame_.o[k];
    double rest[4] = {1, 1, 1, 1};
    for (int k = 0; k < 3; ++k) {
      bool any = false;
      for (int j = 0; j < 4; ++j) {
        const double* row = frame_.row[k];
        const double at = row[0] * d[0][j] + row[1] * d[1][j] + row[2] * d[2][j];
        planes[k + 1][j] = at;
        rest[j] -= at;
        any |= at > 0;
      }
      if (!any) return false;
    }
    bool any = false;
    for (int j = 0; j < 4; ++j) {
      planes[0][j] = rest[j];
      any |= rest[j] > 0;
    }
    return any;
  }

  static constexpr double kFlat = 1e-12;

 private:
  CellFrame frame_;
};

struct CellOverlap {
  static constexpr int kMostPieces = 81;  // each of four planes leaves at most three of one

  double volume;       // share of a
  double moments[10];  // M: 00 11 22 33 01 02 03 12 13 23
  int pieces;
  double piece[kMostPieces][4][4];

  // `planes[k][i]`: the k-th coordinate in b of a's corner i, for each k somewhere positive. False
  // if there is nothing in common.
  bool set(const double planes[4][4]);
  // Integral of the square of the linear function, as a share of a's volume.
  double integralOfSquare(const double d[4]) const;

 private:
  void cut(const double corners[4][4], const double planes[4][4], int plane);
  void keep(const double corners[4][4]);
};

}  // namespace tetstream
