#include "orient.h"

#include <cmath>
#include <initializer_list>
#include <limits>

namespace tetstream {

// ------------------------------------------------------------------------- exact arithmetic
// An expansion is a sum of doubles, none overlapping another, in increasing magnitude; its sign is
// that of its last term. Zeros are left out, so that simple coordinates stay short.

namespace {

// Products that underflow are outside the filter's bound. Where the bound is above kLeastBound and
// no coordinate difference above kLargestDifference, they change less than what it was raised by.
constexpr double kLeastBound = 1e-250, kLargestDifference = 1e60;

struct Sum {
  double value, error;
};

inline Sum twoSum(double a, double b) {
  const double s = a + b, b_part = s - a, a_part = s - b_part;
  return {s, (a - a_part) + (b - b_part)};
}

inline Sum twoProduct(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

// Room for the largest: 3 products of a difference (2 terms) and a minor (16 terms): 3 * 64.
struct Expansion {
  double term[192];
  int size = 0;

  void add(double b) {
    int kept = 0;
    for (int i = 0; i < size; ++i) {
      const Sum s = twoSum(b, term[i]);
      if (s.error != 0) term[kept++] = s.error;
      b = s.value;
    }
    if (b != 0) term[kept++] = b;
    size = kept;
  }
  void add(const Expansion& other) {
    for (int i = 0; i < other.size; ++i) add(other.term[i]);
  }
  int sign() const { return size == 0 ? 0 : (term[size - 1] > 0) - (term[size - 1] < 0); }
};

Expansion differenceOf(double a, double b) {
  Expansion e;
  const Sum s = twoSum(a, -b);
  if (s.error != 0) e.term[e.size++] = s.error;
  if (s.value != 0) e.term[e.size++] = s.value;
  return e;
}

// out += sign * a * b
void addProduct(const Expansion& a, const Expansion& b, double sign, Expansion& out) {
  for (int i = 0; i < a.size; ++i)
    for (int j = 0; j < b.size; ++j) {
      const Sum p = twoProduct(sign * a.term[i], b.term[j]);
      if (p.error != 0) out.add(p.error);
      if (p.value != 0) out.add(p.value);
    }
}

// Powers of two along an axis change no sign; with the largest coordinate of each axis near 1 no
// product overflows, and what underflows is 2^-300 smaller than all else along its axis.
double scaleFor(const double* const p[4], int axis) {
  double largest = 0;
  for (int k = 0; k < 4; ++k) largest = std::fmax(largest, std::fabs(p[k][axis]));
  int exponent = 0;
  if (largest > 0) std::frexp(largest, &exponent);
  return std::ldexp(1.0, exponent > 1000 ? -1000 : exponent < -1000 ? 1000 : -exponent);
}

// Cells for which no arithmetic is needed, of boxes and of what is drawn out along an axis: all
// corners in a plane across an axis, or two pairs of them on lines along the same one.
bool inPlaneOfAxis(const double* const p[4]) {
  const auto same = [p](int k, int l, int axis) { return p[k][axis] == p[l][axis]; };
  const auto along = [same](int k, int l, int axis) {
    return same(k, l, (axis + 1) % 3) && same(k, l, (axis + 2) % 3);
  };
  for (int axis = 0; axis < 3; ++axis) {
    if (same(0, 1, axis) && same(0, 2, axis) && same(0, 3, axis)) return true;
    for (int k = 1; k < 4; ++k)
      if (along(0, k, axis) && along(k % 3 + 1, (k + 1) % 3 + 1, axis)) return true;
  }
  return false;
}

int exactOrientation(const double* const p[4]) {
  Expansion d[3][3];
  for (int i = 0; i < 3; ++i) {
    const double scale = scaleFor(p, i);
    for (int k = 0; k < 3; ++k) d[k][i] = differenceOf(p[k + 1][i] * scale, p[0][i] * scale);
  }
  Expansion det;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    Expansion minor, part;
    addProduct(d[1][j], d[2][k], 1, minor);
    addProduct(d[1][k], d[2][j], -1, minor);
    addProduct(d[0][i], minor, 1, part);
    det.add(part);
  }
  return det.sign();
}

}  // namespace

int orientation(const double a[3], const double b[3], const double c[3], const double d[3]) {
  double e[3][3];
  const double* const corners[3] = {b, c, d};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) e[k][i] = corners[k][i] - a[i];
  double det = 0, bound = 0, size = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double p = e[1][j] * e[2][k], q = e[1][k] * e[2][j];
    det += e[0][i] * (p - q);
    bound += std::fabs(e[0][i]) * (std::fabs(p) + std::fabs(q));
    size += std::fabs(e[0][i]);
  }
  bound *= kOrientationBound;
  if (bound > kLeastBound && size < kLargestDifference) {
    if (det > bound) return 1;
    if (det < -bound) return -1;
  }
  const double* const points[4] = {a, b, c, d};
  return inPlaneOfAxis(points) ? 0 : exactOrientation(points);
}

double largestDifference(const double a[3], const double b[3], const double c[3],
                         const double d[3]) {
  double largest = std::numeric_limits<double>::min();
  for (const double* p : {b, c, d})
    for (int i = 0; i < 3; ++i) largest = std::fmax(largest, std::fabs(p[i] - a[i]));
  return largest;
}

}  // namespace tetstream
