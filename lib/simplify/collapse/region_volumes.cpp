#include "region_volumes.h"

#include <algorithm>
#include <cmath>

#include "vector3.h"

namespace tetstream {

// Of the largest gradient, squared: what a step of the edge's length may cost, so that what the
// sheets do not determine stays as it is; and of that, what it costs in every direction.
constexpr double kRegular = 1e-4, kSame = 0.01;
// Than the least step: the cheapest would run far along a sheet that is nearly plane.
constexpr double kLonger = 1.5;

// `likely`: the region of the cell before.
inline size_t RegionVolumes::of(const int64_t* row, const CellLabels& labels, size_t likely) {
  if (likely < changes_.size() && !labels.differ(changes_[likely].row, row)) return likely;
  for (size_t i = 0; i < changes_.size(); ++i)
    if (i != likely && !labels.differ(changes_[i].row, row)) return i;
  changes_.push_back({row, 0, {}, {}});
  return changes_.size() - 1;
}

// Parts are numbered as they are met.
size_t RegionVolumes::ofPart(size_t part) {
  if (part == changes_.size()) changes_.push_back({nullptr, 0, {}, {}});
  return part;
}

template <class S>
static void place(const S* at, double out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = static_cast<double>(at[i]);
}

namespace {

// Of a cell, seen from one of its vertices: a corner of the face opposite, and twice its area.
struct FaceOpposite {
  double corner[3], normal[3];
};
template <class S>
inline FaceOpposite faceOpposite(const StarCell& cell, const S* values, size_t stride) {
  FaceOpposite face;
  double t[3][3];
  for (size_t k = 0; k < 3; ++k) place(values + cell.t[k] * stride, t[k]);
  for (size_t i = 0; i < 3; ++i) {
    face.corner[i] = t[0][i];
    t[1][i] -= t[0][i];
    t[2][i] -= t[0][i];
  }
  cross(t[1], t[2], face.normal);
  return face;
}

}  // namespace

// A cell with the vertex at c has 6 V = (t0 - c) . n with n = (t1 - t0) x (t2 - t0): from there to
// the origin its volume grows by c . n, and -n is its gradient.
template <class S, class ChangeOf>
void RegionVolumes::addCells(const Stars& stars, const S* values, size_t stride, const double x[3],
                             const double tip[3], ChangeOf changeOf) {
  const auto addFaces = [&](const Star& star, size_t end) {
    for (const StarCell& s : star) {
      const FaceOpposite face = faceOpposite(s, values, stride);
      Change& change = changeOf(s);
      for (size_t i = 0; i < 3; ++i) change.faces[end][i] += face.normal[i];
    }
  };
  addFaces(stars.u, 0);
  for (const StarCell& s : stars.ring) {
    const FaceOpposite face = faceOpposite(s, values, stride);
    Change& change = changeOf(s);
    for (size_t i = 0; i < 3; ++i)
      change.volume -= (face.corner[i] - x[i] - tip[i]) * face.normal[i];
  }
  addFaces(stars.v, 1);
}

template <class S>
void RegionVolumes::measure(const Stars& stars, const uint32_t ends[2], const S* values,
                            size_t stride, const double x[3], const CellLabels& labels,
                            const SheetSides* sides) {
  changes_.clear();
  double tip[2][3];
  for (size_t k = 0; k < 2; ++k) {
    place(values + ends[k] * stride, tip[k]);
    for (size_t i = 0; i < 3; ++i) tip[k][i] -= x[i];
  }
  for (size_t i = 0; i < 3; ++i) edge_[i] = tip[1][i] - tip[0][i];
  if (sides) {
    size_t cell = 0;
    addCells(stars, values, stride, x, tip[0],
             [&](const StarCell&) -> Change& { return changes_[ofPart(sides->of(cell++))]; });
  } else if (labels.count > 0) {
    size_t region = 0;
    addCells(stars, values, stride, x, tip[0], [&](const StarCell& s) -> Change& {
      return changes_[region = of(labels.rowOf(s.cell), labels, region)];
    });
  } else {
    Change body = {nullptr, 0, {}, {}};  // stays in registers
    addCells(stars, values, stride, x, tip[0], [&](const StarCell&) -> Change& { return body; });
    changes_.push_back(body);
  }
  close(tip);
}

// The sums over all cells of each end.
void RegionVolumes::close(const double ends[2][3]) {
  for (Change& change : changes_)
    for (size_t k = 0; k < 2; ++k) {
      change.volume += dot(ends[k], change.faces[k]);
      for (size_t i = 0; i < 3; ++i) change.gradient[i] -= change.faces[k][i];
    }
}

// Of six times the volume, in cubes of the edge's length: what round faces have whose radius is 250
// times that. Plane ones that are not along the axes have less by the rounding of floats, as long
// as they are no more than 16,000 edges from the origin.
constexpr double kNoChange = 1e-3;

// In lengths of the edge: what a wall would have to move by, to make up for a change of volume that
// is kept in its plane instead. Where walls have chamfers of a thousandth they came off them by
// that (0.49 of the area was left in them at 0.02, 0.94 now); bodies had as much of their volume
// with 0.01.
constexpr double kSlight = 0.003;

double RegionVolumes::leastChange() const {
  const double square = dot(edge_, edge_);
  return kNoChange * square * std::sqrt(square);
}

bool RegionVolumes::anyChanges() const {
  const double least = leastChange();
  return std::any_of(changes_.begin(), changes_.end(),
                     [least](const Change& change) { return std::fabs(change.volume) > least; });
}

bool RegionVolumes::areKeptInPlanes(const double step[3]) const {
  const double least = leastChange(), slight = kSlight * std::sqrt(dot(edge_, edge_));
  return std::all_of(changes_.begin(), changes_.end(), [=](const Change& change) {
    const double left = std::fabs(change.volume + dot(change.gradient, step));
    return left <= std::max(least, slight * std::sqrt(dot(change.gradient, change.gradient)));
  });
}

// In units of the edge: gradients whose square is less are rounding, as at the tip of a crack,
// whose two faces cancel.
constexpr double kNoGradient = 1e-20;
// Of the whole, where a place stays in planes: what is left of theirs is rounding, too.
constexpr double kPartLeft = 1e-6;

namespace {

// Least squares: the sum of g g^T and what a step costs, times it, is minus the sum of g times the
// change.
struct StepEquations {
  double m[3][3] = {}, right[3] = {};

  void add(const double g[3], double change) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j] += g[i] * g[j];
      right[i] -= g[i] * change;
    }
  }
  double trace() const { return m[0][0] + m[1][1] + m[2][2]; }
  // With `same` for every direction and `share` of the form besides, but along axes on which the
  // place stays: there the step is none.
  void cost(double same, double share, const double form[6], const bool stays[3]) {
    for (int i = 0; i < 3; ++i) {
      m[i][i] += same;
      for (int j = 0; j <= i && !stays[i]; ++j) {
        if (stays[j]) continue;
        const double part = share * form[i * (i + 1) / 2 + j];
        m[i][j] += part;
        if (j < i) m[j][i] += part;
      }
    }
  }
  // Nothing where they do not determine it. Returns its squared length.
  double solve(double out[3]) const {
    const double whole = determinant(m[0], m[1], m[2]);
    for (int k = 0; k < 3; ++k) {
      double swapped[3][3];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) swapped[j][i] = j == k ? right[i] : m[i][j];
      out[k] = std::fabs(whole) > 0 ? determinant(swapped[0], swapped[1], swapped[2]) / whole : 0;
    }
    return dot(out, out);
  }
};

}  // namespace

// In units of the edge, its largest component.
bool RegionVolumes::step(const double form[6], const bool stays[3], double out[3]) const {
  StepEquations least;
  std::fill_n(out, 3, 0.0);
  const double unit = std::max({std::fabs(edge_[0]), std::fabs(edge_[1]), std::fabs(edge_[2])});
  if (!(unit > 0)) return true;
  for (const Change& c : changes_) {
    double g[3], whole = 0;
    for (int i = 0; i < 3; ++i) {
      g[i] = c.gradient[i] / unit / unit;
      whole += g[i] * g[i];
      if (stays[i]) g[i] = 0;
    }
    if (dot(g, g) > std::max(kNoGradient, kPartLeft * whole))
      least.add(g, c.volume / unit / unit / unit);
  }
  StepEquations cheapest = least;
  const double regular = kRegular * least.trace(), trace = form[0] + form[2] + form[5];
  least.cost(regular, 0, form, stays);
  double length = least.solve(out), other[3];
  if (trace > 0 && std::isfinite(trace)) {
    cheapest.cost(kSame * regular, regular / trace, form, stays);
    const double square = cheapest.solve(other);
    if (square <= kLonger * kLonger * length) {
      std::copy_n(other, 3, out);
      length = square;
    }
  }
  for (int i = 0; i < 3; ++i) out[i] *= unit;
  return length * unit * unit <= dot(edge_, edge_);
}

template void RegionVolumes::measure<float>(const Stars&, const uint32_t[2], const float*, size_t,
                                            const double[3], const CellLabels&, const SheetSides*);
template void RegionVolumes::measure<double>(const Stars&, const uint32_t[2], const double*, size_t,
                                             const double[3], const CellLabels&, const SheetSides*);

}  // namespace tetstream
