#include "region_volumes.h"

#include <cmath>

#include "vector3.h"

namespace tetstream {

// Of the largest gradient, squared: what the sheets do not determine stays as it is.
constexpr double kRegular = 1e-4;

RegionVolumes::Change& RegionVolumes::of(uint32_t cell, const CellLabels& labels) {
  for (Change& change : changes_)
    if (!labels.differ(change.cell, cell)) return change;
  changes_.push_back({cell, 0, {0, 0, 0}});
  return changes_.back();
}

// Parts are numbered as they are met.
RegionVolumes::Change& RegionVolumes::ofPart(size_t part, uint32_t cell) {
  if (part == changes_.size()) changes_.push_back({cell, 0, {0, 0, 0}});
  return changes_[part];
}

template <class S>
void RegionVolumes::measure(const Stars& stars, const uint32_t ends[2], const S* values,
                            size_t stride, const double x[3], const CellLabels& labels,
                            const SheetSides* sides) {
  changes_.clear();
  size_t place = 0;
  const auto relative = [&](uint32_t v, double* out) {
    for (size_t i = 0; i < 3; ++i) out[i] = static_cast<double>(values[v * stride + i]) - x[i];
  };
  double tip[2][3];
  for (size_t k = 0; k < 2; ++k) relative(ends[k], tip[k]);
  for (size_t i = 0; i < 3; ++i) edge_[i] = tip[1][i] - tip[0][i];
  for (const Star* star : {&stars.u, &stars.ring, &stars.v}) {
    double centre[3];
    relative(ends[star == &stars.v], centre);
    for (const StarCell& s : *star) {
      double t[3][3], e[2][3], before[3][3];
      for (size_t k = 0; k < 3; ++k) relative(s.t[k], t[k]);
      for (size_t i = 0; i < 3; ++i) {
        for (size_t k = 0; k < 3; ++k) before[k][i] = t[k][i] - centre[i];
        for (size_t k = 0; k < 2; ++k) e[k][i] = t[k + 1][i] - t[0][i];
      }
      Change& change = sides ? ofPart(sides->of(place++), s.cell) : of(s.cell, labels);
      change.volume -= determinant(before[0], before[1], before[2]) / 6;
      if (star == &stars.ring) continue;
      change.volume += determinant(t[0], t[1], t[2]) / 6;
      for (size_t i = 0; i < 3; ++i)
        change.gradient[i] -=
            (e[0][(i + 1) % 3] * e[1][(i + 2) % 3] - e[0][(i + 2) % 3] * e[1][(i + 1) % 3]) / 6;
    }
  }
}

// Least squares: sum of g g^T times the step is minus the sum of g times the change.
bool RegionVolumes::step(double out[3]) const {
  double m[3][3] = {}, right[3] = {}, largest = 0;
  for (const Change& c : changes_)
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j] += c.gradient[i] * c.gradient[j];
      right[i] -= c.gradient[i] * c.volume;
    }
  for (int i = 0; i < 3; ++i) largest += m[i][i];
  for (int i = 0; i < 3; ++i) {
    out[i] = 0;
    m[i][i] += kRegular * largest;
  }
  const double whole = determinant(m[0], m[1], m[2]);
  if (!(std::fabs(whole) > 0)) return true;
  for (int k = 0; k < 3; ++k) {
    double swapped[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) swapped[j][i] = j == k ? right[i] : m[i][j];
    out[k] = determinant(swapped[0], swapped[1], swapped[2]) / whole;
  }
  return dot(out, out) <= dot(edge_, edge_);
}

template void RegionVolumes::measure<float>(const Stars&, const uint32_t[2], const float*, size_t,
                                            const double[3], const CellLabels&, const SheetSides*);
template void RegionVolumes::measure<double>(const Stars&, const uint32_t[2], const double*, size_t,
                                             const double[3], const CellLabels&, const SheetSides*);

}  // namespace tetstream
