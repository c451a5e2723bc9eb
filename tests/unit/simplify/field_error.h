// tests: the error of the fields of a result, measured at the vertices of the original.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
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

// The cells of a mesh, in slabs along z: those that may hold a place are few then.
class CellSearch {
 public:
  explicit CellSearch(const TestMesh& mesh) : slabs_(kSlabs), all_(mesh.cellCount()) {
    double high = -low_;
    for (size_t c = 0; c < mesh.cellCount(); ++c) {
      cells_.push_back(barycentric(mesh, c));
      low_ = std::min(low_, cells_[c].low[2]);
      high = std::max(high, cells_[c].high[2]);
    }
    height_ = (high - low_) / kSlabs;
    for (size_t c = 0; c < mesh.cellCount(); ++c)
      for (size_t s = slabOf(cells_[c].low[2]); s <= slabOf(cells_[c].high[2]); ++s)
        slabs_[s].push_back(c);
    std::iota(all_.begin(), all_.end(), size_t{0});
  }

  // Where x lies; outside of all, in the cell that it lies least outside of.
  InCell find(const double x[3]) const {
    InCell found;
    double deepest = -std::numeric_limits<double>::infinity();
    for (const std::vector<size_t>* among : {&slabs_[slabOf(x[2])], &all_})
      for (size_t i = 0; i < among->size() && deepest < 0; ++i) {
        const size_t c = (*among)[i];
        if (among != &all_ && !cells_[c].mayHold(x)) continue;
        const Weights w = cells_[c].at(x);
        if (w.smallest() <= deepest) continue;
        deepest = w.smallest();
        found = {c, w};
      }
    return found;
  }

 private:
  static constexpr size_t kSlabs = 64;
  size_t slabOf(double z) const {
    const double slab = (z - low_) / height_;
    return slab > 0 ? static_cast<size_t>(std::min(slab, kSlabs - 1.0)) : 0;
  }

  double low_ = std::numeric_limits<double>::infinity(), height_ = 0;
  std::vector<Barycentric> cells_;
  std::vector<std::vector<size_t>> slabs_;
  std::vector<size_t> all_;
};

// Of each field, in its unit: root mean square, over the vertices of the original, of the error's
// length where the vertex lies.
inline std::vector<double> fieldErrors(const TestMesh& original, const TestMesh& result) {
  const CellSearch cells(result);
  std::vector<double> sums(original.fields.size(), 0);
  for (size_t v = 0; v < original.vertexCount(); ++v) {
    const double x[3] = {original.position(v, 0), original.position(v, 1), original.position(v, 2)};
    const InCell at = cells.find(x);
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
