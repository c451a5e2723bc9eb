#include "symmetric_eigen.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tetstream {

namespace {

// Rows i and j of a matrix with n columns become c * i - s * j and s * i + c * j.
void rotateRows(double* matrix, size_t n, size_t i, size_t j, double c, double s) {
  double *a = matrix + i * n, *b = matrix + j * n;
  for (size_t k = 0; k < n; ++k) {
    const double x = a[k], y = b[k];
    a[k] = c * x - s * y;
    b[k] = s * x + c * y;
  }
}

void rotateColumns(double* matrix, size_t n, size_t i, size_t j, double c, double s) {
  for (double* row = matrix; row < matrix + n * n; row += n) {
    const double x = row[i], y = row[j];
    row[i] = c * x - s * y;
    row[j] = s * x + c * y;
  }
}

double squaredOffDiagonal(const std::vector<double>& matrix, size_t n) {
  double sum = 0;
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j < n; ++j)
      if (i != j) sum += matrix[i * n + j] * matrix[i * n + j];
  return sum;
}

// One sweep over all pairs, each rotated so that its entry becomes 0:
// t = tan of the angle solves t^2 + 2 t h - 1 = 0 with h = (m_jj - m_ii) / (2 m_ij).
void sweep(std::vector<double>& matrix, std::vector<double>& vectors, size_t n) {
  for (size_t i = 0; i < n; ++i)
    for (size_t j = i + 1; j < n; ++j) {
      const double entry = matrix[i * n + j];
      if (entry == 0) continue;
      const double h = (matrix[j * n + j] - matrix[i * n + i]) / (2 * entry);
      const double t = (h < 0 ? -1 : 1) / (std::fabs(h) + std::sqrt(h * h + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      rotateRows(matrix.data(), n, i, j, c, s);
      rotateColumns(matrix.data(), n, i, j, c, s);
      rotateRows(vectors.data(), n, i, j, c, s);
    }
}

}  // namespace

Eigen symmetricEigen(std::vector<double> matrix, size_t n) {
  constexpr int kMostSweeps = 40;  // some ten are enough
  std::vector<double> vectors(n * n, 0.0);
  for (size_t i = 0; i < n; ++i) vectors[i * n + i] = 1;
  double all = squaredOffDiagonal(matrix, n);
  for (size_t i = 0; i < n; ++i) all += matrix[i * n + i] * matrix[i * n + i];
  for (int i = 0; i < kMostSweeps && squaredOffDiagonal(matrix, n) > 1e-30 * all; ++i)
    sweep(matrix, vectors, n);
  std::vector<size_t> order(n);
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return matrix[a * n + a] < matrix[b * n + b]; });
  Eigen eigen;
  for (size_t i : order) {
    eigen.values.push_back(matrix[i * n + i]);
    eigen.vectors.insert(eigen.vectors.end(), &vectors[i * n], &vectors[i * n] + n);
  }
  return eigen;
}

}  // namespace tetstream
