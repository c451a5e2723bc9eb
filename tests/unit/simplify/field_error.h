// tests: the error of the fields of a result, measured at the vertices of the original.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "test_mesh.h"

namespace tetstream::test {

struct Weights {
  double of[4];
  double smallest() const { return *std::min_element(of, of + 4); }
};

// A cell as three rows that give the weights of its last three corners: w = rows (x - corner 0).
struct Barycentric {
  double origin[3], rows[3][3], low[3], high[3];

  bool mayHold(const double x[3]) const {
    for (int i = 0; i < 3; ++i)
      if (x[i] < low[i] || x[i] > high[i]) return false;
    return true;
  }

  Weights at(const double x[3]) const {
    Weights w = {{1, 0, 0, 0}};
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) w.of[k + 1] += rows[k][i] * (x[i] - origin[i]);
      w.of[0] -= w.of[k + 1];
    }
    return w;
  }
};

inline void cross(const double a[3], const double b[3], double out[3]) {
  for (int i = 0; i < 3; ++i)
    out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

inline Barycentric barycentric(const TestMesh& mesh, size_t cell) {
  Barycentric b;
  double edges[3][3];
  const int64_t* corners = &mesh.cells[4 * cell];
  for (int i = 0; i < 3; ++i) {
    b.low[i] = b.high[i] = b.origin[i] = mesh.position(static_cast<size_t>(corners[0]), i);
    for (int k = 0; k < 3; ++k) {
      const double x = mesh.position(static_cast<size_t>(corners[k + 1]), i);
      edges[k][i] = x - b.origin[i];
      b.low[i] = std::min(b.low[i], x);
      b.high[i] = std::max(b.high[i], x);
    }
  }
  for (int k = 0; k < 3; ++k) cross(edges[(k + 1) % 3], edges[(k + 2) % 3], b.rows[k]);
  double volume = 0;
  for (int i = 0; i < 3; ++i) volume += edges[0][i] * b.rows[0][i];
  for (auto& row : b.rows)
    for (double& number : row) number /= volume;
  return b;
}

struct InCell {
  size_t cell = 0;
  Weights weights = {{0, 0, 0, 0}};
};

// Where x lies; outside of all, in the cell that it lies least outside of.
inline InCell inCellOf(const double x[3], const std::vector<Barycentric>& cells) {
  InCell found;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const bool only_near : {true, false})
    for (size_t c = 0; c < cells.size() && deepest < 0; ++c) {
      if (only_near && !cells[c].mayHold(x)) continue;
      const Weights w = cells[c].at(x);
      if (w.smallest() <= deepest) continue;
      deepest = w.smallest();
      found = {c, w};
    }
  return found;
}

// Of each field, in its unit: root mean square, over the vertices of the original, of the error's
// length where the vertex lies.
inline std::vector<double> fieldErrors(const TestMesh& original, const TestMesh& result) {
  std::vector<Barycentric> cells;
  for (size_t c = 0; c < result.cellCount(); ++c) cells.push_back(barycentric(result, c));
  std::vector<double> sums(original.fields.size(), 0);
  for (size_t v = 0; v < original.vertexCount(); ++v) {
    const double x[3] = {original.position(v, 0), original.position(v, 1), original.position(v, 2)};
    const InCell at = inCellOf(x, cells);
    for (size_t f = 0; f < sums.size(); ++f)
      for (int i = 0; i < original.schema.fields[f].components; ++i) {
        double error = -original.field(f, v, i);
        for (size_t k = 0; k < 4; ++k)
          error += at.weights.of[k] *
                   result.field(f, static_cast<size_t>(result.cells[4 * at.cell + k]), i);
        sums[f] += error * error;
      }
  }
  for (double& sum : sums) sum = std::sqrt(sum / static_cast<double>(original.vertexCount()));
  return sums;
}

}  // namespace tetstream::test
