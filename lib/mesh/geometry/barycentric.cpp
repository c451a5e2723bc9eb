#include "barycentric.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vector3.h"

namespace tetstream {

namespace {

// Three equations for three unknowns, a[i][j] z[j] = b[i]. Gauss's elimination with complete
// pivoting: its residual is small even where the unknowns are not well determined.
struct Equations {
  double a[3][3], b[3];
  int column[3] = {0, 1, 2};  // where each unknown stands now
  double least_share = 0;     // of the first pivot that another one has to be larger than
  double least = 0;

  bool pivot(int k) {
    int row = k, col = k;
    for (int i = k; i < 3; ++i)
      for (int j = k; j < 3; ++j)
        if (std::fabs(a[i][j]) > std::fabs(a[row][col])) row = i, col = j;
    if (!(std::fabs(a[row][col]) > least)) return false;
    if (k == 0) least = least_share * std::fabs(a[row][col]);
    std::swap(a[k], a[row]);
    std::swap(b[k], b[row]);
    for (auto& equation : a) std::swap(equation[k], equation[col]);
    std::swap(column[k], column[col]);
    return true;
  }

  // Unknowns that no equation determines are 0.
  void solve(double z[3]) {
    int rank = 0;
    for (; rank < 3 && pivot(rank); ++rank)
      for (int i = rank + 1; i < 3; ++i) {
        const double factor = a[i][rank] / a[rank][rank];
        for (int j = rank; j < 3; ++j) a[i][j] -= factor * a[rank][j];
        b[i] -= factor * b[rank];
      }
    double y[3] = {0, 0, 0};
    for (int i = rank; i-- > 0;) {
      double sum = b[i];
      for (int j = i + 1; j < rank; ++j) sum -= a[i][j] * y[j];
      y[i] = sum / a[i][i];
    }
    for (int i = 0; i < 3; ++i) z[column[i]] = y[i];
  }
};

int nearestCorner(const double p[4][3], const double x[3]) {
  int nearest = 0;
  double least = 0;
  for (int k = 0; k < 4; ++k) {
    double distance = 0;
    for (int i = 0; i < 3; ++i) distance += (x[i] - p[k][i]) * (x[i] - p[k][i]);
    if (k == 0 || distance < least) nearest = k, least = distance;
  }
  return nearest;
}

}  // namespace

// Relative to the nearest corner o: sum over the others of w_k (p_k - o) = x - o.
void barycentricWeights(const double p[4][3], const double x[3], double w[4]) {
  const int o = nearestCorner(p, x);
  Equations e;
  int other[3], count = 0;
  for (int k = 0; k < 4; ++k)
    if (k != o) other[count++] = k;
  for (int i = 0; i < 3; ++i) {
    e.b[i] = x[i] - p[o][i];
    for (int j = 0; j < 3; ++j) e.a[i][j] = p[other[j]][i] - p[o][i];
  }
  Equations roughly = e;
  roughly.least_share = 1 / kLargestWeight;
  double z[3];
  e.solve(z);
  const auto isTooLarge = [](double weight) { return std::fabs(weight) > kLargestWeight; };
  if (std::any_of(z, z + 3, isTooLarge)) roughly.solve(z);
  for (int j = 0; j < 3; ++j) w[other[j]] = z[j];
  w[o] = 1 - z[0] - z[1] - z[2];
  bool inexact = false;
  for (int k = 0; k < 4; ++k) {
    if (!(w[k] < 0 && w[k] > -kLeastOutside)) continue;
    w[k] = 0;
    inexact = true;
  }
  if (!inexact) return;
  double* const largest = std::max_element(w, w + 4);
  *largest = 1;
  for (int k = 0; k < 4; ++k)
    if (w + k != largest) *largest -= w[k];
}

// The rows of the inverse of (a b c) are b x c, c x a and a x b over det (a b c).
double CellFrame::set(const double* corners) {
  double e[3][3];
  for (int i = 0; i < 3; ++i) o[i] = corners[i];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) e[k][i] = corners[3 * (k + 1) + i] - o[i];
  const double det = determinant(e[0], e[1], e[2]);
  for (int k = 0; k < 3; ++k) {
    cross(e[(k + 1) % 3], e[(k + 2) % 3], row[k]);
    for (double& number : row[k]) number /= det;
  }
  return det;
}

void clampedWeights(const double p[4][3], const double x[3], double w[4]) {
  double e[3][3], d[3];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) e[k][i] = p[k + 1][i] - p[0][i];
    d[i] = x[i] - p[0][i];
  }
  const double whole = determinant(e[0], e[1], e[2]);
  if (whole == 0) return;
  w[1] = determinant(d, e[1], e[2]) / whole;
  w[2] = determinant(e[0], d, e[2]) / whole;
  w[3] = determinant(e[0], e[1], d) / whole;
  w[0] = 1 - w[1] - w[2] - w[3];
  double sum = 0;
  for (int k = 0; k < 4; ++k) sum += w[k] = std::max(w[k], 0.0);
  for (int k = 0; k < 4; ++k) w[k] /= sum;
}

}  // namespace tetstream
