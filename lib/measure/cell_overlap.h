// measure: what two cells have in common, and integrals over it: arithmetic only. Depends on
// nothing.
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

namespace tetstream {

// Six times the volume, with its sign.
double sixVolumes(const double a[3], const double b[3], const double c[3], const double d[3]);

// From places to the barycentric coordinates of a cell.
class CellMap {
 public:
  // False if the cell is too flat to have any: its volume is below kFlat of a regular one's of its
  // longest edge.
  bool set(const double* corners);  // [4][3]
  void coordinates(const double place[3], double out[4]) const;

  static constexpr double kFlat = 1e-12;

 private:
  double origin_[3], rows_[3][3];
};

struct CellOverlap {
  static constexpr int kMostPieces = 81;  // each of four planes leaves at most three of one

  double volume;       // share of a
  double moments[10];  // M: 00 11 22 33 01 02 03 12 13 23
  int pieces;
  double piece[kMostPieces][4][4];

  // `planes[k][i]`: the k-th coordinate in b of a's corner i. False if there is nothing in common.
  bool set(const double planes[4][4]);
  // Integral of the square of the linear function, as a share of a's volume.
  double integralOfSquare(const double d[4]) const;

 private:
  void cut(const double corners[4][4], const double planes[4][4], int plane);
  void keep(const double corners[4][4]);
};

}  // namespace tetstream
