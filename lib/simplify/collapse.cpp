#include "collapse.h"

#include <algorithm>

namespace tetstream {

// Cells of less than this share of the regular cell's shape, a mean ratio of 0.01, are flat for all
// purposes: rounding to float32 or another program's arithmetic may turn them over. Larger values
// give better shapes at the price of field error.
constexpr double kLeastShape = 1e-3;

template <class S>
Collapser<S>::Collapser(Core<S>& core, Account& account)
    : core_(core),
      link_(account),
      around_u_(account),
      around_v_(account),
      merged_(static_cast<size_t>(core.plan.values)) {}

template <class S>
void Collapser<S>::endOf(uint32_t u, uint32_t v, bool at_v, S* z) const {
  const S *a = core_.window.values(u), *b = core_.window.values(v);
  for (size_t i = 0; i < core_.scale.size(); ++i) {
    const S half = S(0.5) * ((b[i] - a[i]) * core_.scale[i]);
    z[i] = at_v ? half : -half;
  }
}

// The new position is rounded to the type in which it is written: what is tested is what the file
// will hold.
template <class S>
void Collapser<S>::placeAt(uint32_t u, uint32_t v, const S* z) {
  const S *a = core_.window.values(u), *b = core_.window.values(v);
  const bool to_float = core_.plan.schema.position_type == ScalarType::kFloat32;
  for (size_t i = 0; i < core_.scale.size(); ++i) {
    merged_[i] = (a[i] + S(0.5) * (b[i] - a[i])) + z[i] * core_.inverse_scale[i];
    if (to_float && i < 3) merged_[i] = static_cast<S>(static_cast<float>(merged_[i]));
  }
}

template <class S>
void Collapser<S>::gatherLanes(const StarCell* const cells[], int count,
                               TriangleLanes& lanes) const {
  for (int k = 0; k < kLanes; ++k) {
    const StarCell& s = *cells[k < count ? k : 0];
    for (int i = 0; i < 3; ++i) {
      const S* p = core_.window.values(s.t[i]);
      for (int j = 0; j < 3; ++j) lanes.xyz[3 * i + j][k] = static_cast<double>(p[j]);
    }
  }
}

template <class S>
bool Collapser<S>::lanesPositive(const StarCell* const cells[], int count, double* worst) {
  TriangleLanes lanes;
  gatherLanes(cells, count, lanes);
  const double x[3] = {static_cast<double>(merged_[0]), static_cast<double>(merged_[1]),
                       static_cast<double>(merged_[2])};
  signed char sign[kLanes];
  double shape[kLanes];
  orientationLanes(x, lanes, count, sign, shape);
  for (int k = 0; k < count; ++k) {
    *worst = std::min(*worst, shape[k]);
    if (sign[k] > 0) continue;
    if (sign[k] < 0) return false;
    double t[3][3];
    for (int i = 0; i < 3; ++i) positionOf(core_.window, cells[k]->t[i], t[i]);
    if (orientation(x, t[0], t[1], t[2]) <= 0) return false;
  }
  return true;
}

// Of the cells of one star that outlive the collapse.
template <class S>
bool Collapser<S>::keepsOrientation(uint32_t other, const Star& star, double* worst) {
  const StarCell* lane[kLanes];
  int count = 0;
  for (const StarCell& s : star) {
    if (s.has(other)) continue;
    lane[count++] = &s;
    if (count < kLanes) continue;
    if (!lanesPositive(lane, count, worst)) return false;
    count = 0;
  }
  return count == 0 || lanesPositive(lane, count, worst);
}

// Of all cells of a star as it is.
template <class S>
double Collapser<S>::worstShape(uint32_t centre, const Star& star) {
  double x[3], worst = 1;
  positionOf(core_.window, centre, x);
  for (size_t at = 0; at < star.size(); at += kLanes) {
    const int count = static_cast<int>(std::min<size_t>(kLanes, star.size() - at));
    const StarCell* cells[kLanes];
    for (int k = 0; k < count; ++k) cells[k] = &star[at + static_cast<size_t>(k)];
    TriangleLanes lanes;
    gatherLanes(cells, count, lanes);
    signed char sign[kLanes];
    double shape[kLanes];
    orientationLanes(x, lanes, count, sign, shape);
    for (int k = 0; k < count; ++k) worst = std::min(worst, shape[k]);
  }
  return worst;
}

template <class S>
Outcome Collapser<S>::test(uint32_t u, uint32_t v, int64_t least_cells) {
  Topology& mesh = core_.window.mesh;
  if (!mesh.isFree(u) || !mesh.isFree(v)) return Outcome::kLocked;
  for (S value : merged_)
    if (!std::isfinite(value)) return Outcome::kNotFinite;
  mesh.gather(u, around_u_);
  mesh.gather(v, around_v_);
  int64_t dying = 0;
  for (const StarCell& s : around_u_) dying += s.has(v);
  if (dying == 0) return Outcome::kTopology;  // no edge any more
  if (mesh.liveCells() - dying < least_cells) return Outcome::kTooMany;
  double worst = 1;
  if (!keepsOrientation(v, around_u_, &worst) || !keepsOrientation(u, around_v_, &worst))
    return Outcome::kOrientation;
  if (worst < kLeastShape && worst < std::min(worstShape(u, around_u_), worstShape(v, around_v_)))
    return Outcome::kOrientation;
  return link_.holds(mesh, u, v, around_u_, around_v_) ? Outcome::kDone : Outcome::kTopology;
}

template <class S>
Outcome Collapser<S>::collapse(uint32_t u, uint32_t v, const S* z, S error, int64_t least_cells) {
  placeAt(u, v, z);
  std::copy_n(core_.window.values(u) + core_.plan.dimension,
              core_.plan.values - core_.plan.dimension, merged_.data() + core_.plan.dimension);
  const Outcome outcome = std::isfinite(error) ? test(u, v, least_cells) : Outcome::kNotFinite;
  Report& report = core_.report;
  switch (outcome) {
    case Outcome::kDone:
      ++report.collapses;
      break;
    case Outcome::kLocked:
      ++report.rejected_locked;
      break;
    case Outcome::kTopology:
      ++report.rejected_link;
      break;
    case Outcome::kOrientation:
      ++report.rejected_orientation;
      break;
    case Outcome::kTooMany:
    case Outcome::kNotFinite:
      ++report.rejected_other;
      break;
  }
  if (outcome == Outcome::kDone) mergeInto(u, v, error);
  return outcome;
}

template <class S>
void Collapser<S>::mergeInto(uint32_t u, uint32_t v, S error) {
  Window<S>& window = core_.window;
  if (core_.plan.values > core_.plan.dimension) interpolateCarried(u, v);
  if (core_.plan.picks > 0) pickNearest(u, v);
  if (core_.plan.cell_means > 0) handOverCellData(v);
  window.mesh.merge(u, v, around_u_, around_v_);
  std::copy(merged_.begin(), merged_.end(), window.values(u));
  S *a = window.quadric(u), *b = window.quadric(v);
  const int last = window.shape().quadric - 1;
  for (int i = 0; i < last; ++i) a[i] += b[i];
  a[last] = error;
  const double in_users_terms = static_cast<double>(error) * core_.error_unit;
  core_.report.largest_error = std::max(core_.report.largest_error, in_users_terms);
  if (observer_) observer_->collapsed(u, v, in_users_terms);
}

// Barycentric coordinates of x in the cell (p0, t), clamped to the cell; returns the smallest of
// them before clamping, which is largest in the cell that holds x.
static double barycentric(const double p[4][3], const double x[3], double out[4]) {
  double e[3][3], d[3];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) e[k][i] = p[k + 1][i] - p[0][i];
    d[i] = x[i] - p[0][i];
  }
  const auto det = [](const double* a, const double* b, const double* c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  const double whole = det(e[0], e[1], e[2]);
  if (whole == 0) return -1e300;
  out[1] = det(d, e[1], e[2]) / whole;
  out[2] = det(e[0], d, e[2]) / whole;
  out[3] = det(e[0], e[1], d) / whole;
  out[0] = 1 - out[1] - out[2] - out[3];
  const double least = std::min({out[0], out[1], out[2], out[3]});
  double sum = 0;
  for (int k = 0; k < 4; ++k) sum += out[k] = std::max(out[k], 0.0);
  for (int k = 0; k < 4; ++k) out[k] /= sum;
  return least;
}

// Carried fields take the value that the old cells have at the new position.
template <class S>
void Collapser<S>::interpolateCarried(uint32_t u, uint32_t v) {
  double x[3], best = -1e301, weights[4] = {1, 0, 0, 0};
  uint32_t corners[4] = {u, u, u, u};
  for (int i = 0; i < 3; ++i) x[i] = static_cast<double>(merged_[static_cast<size_t>(i)]);
  for (const Star* star : {&around_u_, &around_v_})
    for (const StarCell& s : *star) {
      if (best >= 0) break;  // x lies in that cell
      const uint32_t c[4] = {star == &around_u_ ? u : v, s.t[0], s.t[1], s.t[2]};
      double p[4][3], w[4];
      for (int k = 0; k < 4; ++k) positionOf(core_.window, c[k], p[k]);
      const double least = barycentric(p, x, w);
      if (!(least > best)) continue;
      best = least;
      std::copy_n(w, 4, weights);
      std::copy_n(c, 4, corners);
    }
  for (int i = core_.plan.dimension; i < core_.plan.values; ++i) {
    double sum = 0;
    for (int k = 0; k < 4; ++k)
      sum += weights[k] * static_cast<double>(core_.window.values(corners[k])[i]);
    merged_[static_cast<size_t>(i)] = static_cast<S>(sum);
  }
}

template <class S>
void Collapser<S>::pickNearest(uint32_t u, uint32_t v) {
  double to_u = 0, to_v = 0;
  for (size_t i = 0; i < 3; ++i) {
    const double s = static_cast<double>(core_.scale[i]), x = static_cast<double>(merged_[i]);
    const double a = (static_cast<double>(core_.window.values(u)[i]) - x) * s;
    const double b = (static_cast<double>(core_.window.values(v)[i]) - x) * s;
    to_u += a * a;
    to_v += b * b;
  }
  if (to_v < to_u) std::copy_n(core_.window.picks(v), core_.plan.picks, core_.window.picks(u));
}

// A dying cell u v a b leaves its volume to the cells across u a b and v a b, half to each, or all
// to the one that is there: float cell data stay the mean over what a cell stands for.
template <class S>
void Collapser<S>::handOverCellData(uint32_t v) {
  const int n = core_.plan.cell_means;
  for (const StarCell& dying : around_u_) {
    if (!dying.has(v)) continue;
    uint32_t heirs[2];
    int count = 0;
    for (const Star* star : {&around_u_, &around_v_})
      for (const StarCell& s : *star) {
        if (s.cell == dying.cell) continue;
        int shared = 0;
        for (uint32_t t : dying.t) shared += t != v && s.has(t);
        const uint32_t* c = core_.window.mesh.corners(dying.cell);
        const uint32_t other = star == &around_u_ ? v : c[dying.corner % 4];
        if (shared == 2 && !s.has(other) && count < 2) heirs[count++] = s.cell;
      }
    const double* from = core_.window.cellMeans(dying.cell);
    for (int k = 0; k < count; ++k) {
      double* to = core_.window.cellMeans(heirs[k]);
      const double share = from[0] / count, sum = to[0] + share;
      for (int i = 1; i <= n && sum > 0; ++i) to[i] += (from[i] - to[i]) * (share / sum);
      to[0] = sum;
    }
  }
}

template class Collapser<float>;
template class Collapser<double>;

}  // namespace tetstream
