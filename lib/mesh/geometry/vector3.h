// mesh/geometry: products of vectors in space. Depends on nothing.
#pragma once

namespace tetstream {

inline void subtract(const double a[3], const double b[3], double out[3]) {
  for (int k = 0; k < 3; ++k) out[k] = a[k] - b[k];
}

inline double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline void cross(const double a[3], const double b[3], double out[3]) {
  for (int i = 0; i < 3; ++i)
    out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

// a . (b x c)
inline double determinant(const double a[3], const double b[3], const double c[3]) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Six times the volume of a cell, with its sign.
inline double sixVolume(const double a[3], const double b[3], const double c[3],
                        const double d[3]) {
  double e[3][3];
  for (int i = 0; i < 3; ++i) {
    e[0][i] = b[i] - a[i];
    e[1][i] = c[i] - a[i];
    e[2][i] = d[i] - a[i];
  }
  return determinant(e[0], e[1], e[2]);
}
inline double sixVolume(const double p[4][3]) {
  return sixVolume(p[0], p[1], p[2], p[3]);
}

}  // namespace tetstream
