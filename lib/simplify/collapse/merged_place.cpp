#include "merged_place.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "barycentric.h"
#include "curve_area.h"
#include "price.h"

namespace tetstream {

// Of an edge's length: nearer to it than this is on it.
constexpr double kOnEdge = 1e-3;
// And to a plane across an axis: where there is nothing else, and beside other faces. The steps of
// voxels may be smoothed away, so that this is less. On ten real meshes and fields errors are the
// same with 0.01 to 0.3, in the mean.
constexpr double kNearPlane = 0.5, kNearPlanes = 0.1;
// What is one plane but for rounding.
constexpr double kSamePlane = 1e-5;

template <class Mesh>
bool MergedPlace<Mesh>::set(uint32_t u, uint32_t v, const S* z) {
  u_ = u;
  v_ = v;
  std::copy_n(z, z_.size(), z_.data());
  leavePlanes();
  std::copy_n(mesh_.values(u) + core_.plan.dimension, core_.plan.values - core_.plan.dimension,
              values_.data() + core_.plan.dimension);
  return update();
}

// The new position is rounded to the type in which it is written: what is tested is what the file
// will hold. Values stay in what their field may have, as far as its range is known, or in what the
// two ends have where a header has told a narrower one; those that are not finite stay, and are
// refused. Returns whether z had to give way.
template <class Mesh>
bool MergedPlace<Mesh>::update() {
  const S *a = mesh_.values(u_), *b = mesh_.values(v_);
  const bool to_float = core_.plan.schema.position_type == ScalarType::kFloat32;
  bool gave_way = false;
  for (size_t i = 0; i < core_.scale.size(); ++i) {
    const S middle = a[i] + S(0.5) * (b[i] - a[i]);
    S& x = values_[i] = middle + z_[i] * core_.inverse_scale[i];
    if (i < 3 && stays_[i]) x = plane_[i];
    if (to_float && i < 3) x = static_cast<S>(static_cast<float>(x));
    if (!(x < core_.least[i] || x > core_.most[i]) || std::isinf(x)) continue;
    x = std::clamp(x, std::min({core_.least[i], a[i], b[i]}),
                   std::max({core_.most[i], a[i], b[i]}));
    z_[i] = (x - middle) * core_.scale[i];
    gave_way = true;
  }
  return gave_way;
}

template <class Mesh>
auto MergedPlace<Mesh>::error() const -> S {
  return core_.kernels.errorAt(mesh_.quadric(u_), mesh_.values(u_), mesh_.quadric(v_),
                               mesh_.values(v_), core_.scale.data(), core_.plan.dimension,
                               z_.data());
}

template <class Mesh>
bool MergedPlace<Mesh>::isFinite() const {
  return std::all_of(values_.begin(), values_.begin() + core_.plan.dimension,
                     [](S x) { return std::isfinite(x); });
}

template <class Mesh>
bool MergedPlace<Mesh>::isFartherFromU() const {
  double difference = 0;
  for (size_t i = 0; i < 3; ++i) {
    const auto a = static_cast<double>(values_[i] - mesh_.values(u_)[i]);
    const auto b = static_cast<double>(values_[i] - mesh_.values(v_)[i]);
    difference += a * a - b * b;
  }
  return difference > 0;
}

// The place goes a step, normalised, and the fields with it to what is best for them there.
template <class Mesh>
void MergedPlace<Mesh>::moveBy(const S step[3]) {
  for (size_t i = 0; i < 3; ++i) z_[i] += step[i];
  core_.kernels.followStep(mesh_.quadric(u_), mesh_.quadric(v_), core_.plan.dimension, step,
                           z_.data());
  update();
}

template <class Mesh>
bool MergedPlace<Mesh>::putOnCurve(bool u_on_it, bool v_on_it) {
  double along[3], square = 0, dot = 0, off = 0;
  for (size_t i = 0; i < 3; ++i) {
    along[i] = static_cast<double>((mesh_.values(v_)[i] - mesh_.values(u_)[i]) * core_.scale[i]);
    square += along[i] * along[i];
    dot += along[i] * static_cast<double>(z_[i]);
  }
  double t = v_on_it ? 0.5 : -0.5;
  if (u_on_it == v_on_it) {
    t = std::clamp(dot / square, -0.5, 0.5);
    for (size_t i = 0; i < 3; ++i) {
      const double d = static_cast<double>(z_[i]) - t * along[i];
      off += d * d;
    }
    if (!(off <= kOnEdge * kOnEdge * square)) return false;
    if (std::fabs(t) >= 0.5 - kOnEdge) t = t > 0 ? 0.5 : -0.5;  // a corner
  }
  S step[3];
  for (size_t i = 0; i < 3; ++i) step[i] = static_cast<S>(t * along[i]) - z_[i];
  moveBy(step);
  if (std::fabs(t) == 0.5) std::copy_n(mesh_.values(t > 0 ? v_ : u_), 3, values_.data());
  return true;
}

template <class Mesh>
bool MergedPlace<Mesh>::keepCurveArea(uint32_t behind_u, uint32_t behind_v) {
  const uint32_t chain[4] = {behind_u, u_, v_, behind_v};
  double p[4][3], x[3];
  S step[3];
  for (size_t i = 0; i < 3; ++i) {
    for (int k = 0; k < 4; ++k) p[k][i] = static_cast<double>(mesh_.values(chain[k])[i]);
    x[i] = static_cast<double>(values_[i]);
  }
  if (!keepArea(p[0], p[1], p[2], p[3], x)) return false;
  for (size_t i = 0; i < 3; ++i) step[i] = (static_cast<S>(x[i]) - values_[i]) * core_.scale[i];
  moveBy(step);
  return true;
}

template <class Mesh>
void MergedPlace<Mesh>::measureVolumes(const Stars& stars, const CellLabels& labels,
                                       const SheetSides* sides) {
  const uint32_t ends[2] = {u_, v_};
  const double x[3] = {at(0), at(1), at(2)};
  volumes_.measure(stars, ends, mesh_.allValues(), static_cast<size_t>(mesh_.valueStride()), x,
                   labels, sides);
}

template <class Mesh>
bool MergedPlace<Mesh>::changesVolumes(const Stars& stars, const CellLabels& labels) {
  measureVolumes(stars, labels, nullptr);
  return volumes_.anyChanges();
}

// As far as it was read.
template <class Mesh>
auto MergedPlace<Mesh>::regionOf(const CellLabels& labels, const int64_t* row) const -> Region {
  const auto unit = static_cast<double>(core_.inverse_scale[0]);
  if (!row) return {nullptr, core_.volume * unit * unit * unit};
  const LabelVolumes::Volumes* const volumes = core_.label_volumes.find(labels, row);
  if (!volumes) return {nullptr, std::numeric_limits<double>::infinity()};
  return {volumes, volumes->of[LabelVolumes::kInput]};
}

template <class Mesh>
bool MergedPlace<Mesh>::givesUpRegion(const CellLabels& labels, const double step[3]) const {
  return volumes_.anyMayNot(step, [&](const int64_t* row, double change) {
    return std::fabs(change) <= kOfARegion * regionOf(labels, row).volume;
  });
}

template <class Mesh>
bool MergedPlace<Mesh>::driftsOff(const CellLabels& labels, const Tally& whole,
                                  const Tally& part) const {
  constexpr double kThere[3] = {0, 0, 0};
  return volumes_.anyMayNot(kThere, [&](const int64_t* row, double change) {
    const Region region = regionOf(labels, row);
    const double before =
        whole.driftOf(region.key) + (&part == &whole ? 0 : part.driftOf(region.key));
    const double drift = std::fabs(before + change);
    return drift <= core_.most_drift * region.volume || drift < std::fabs(before);
  });
}

template <class Mesh>
void MergedPlace<Mesh>::addDrifts(const CellLabels& labels, Tally& tally) const {
  volumes_.forChanges([&](const int64_t* row, double change) {
    tally.drifts[regionOf(labels, row).key] += change;
  });
}

template <class Mesh>
auto MergedPlace<Mesh>::keepVolumes(const Stars& stars, const CellLabels& labels,
                                    const SheetSides* sides) -> S {
  measureVolumes(stars, labels, sides);
  double step[3], form[6];
  S cost[6];
  core_.kernels.spaceForm(mesh_.quadric(u_), mesh_.quadric(v_), core_.plan.dimension, cost);
  std::copy_n(cost, 6, form);
  bool is_near = volumes_.step(form, stays_, step);
  if (staysAnywhere() && !(is_near && volumes_.areKeptInPlanes(step))) {
    leavePlanes();
    is_near = volumes_.step(form, stays_, step);
  }
  const bool has_regions = labels.count > 0;
  if ((!is_near && (has_regions || !sides)) || (has_regions && givesUpRegion(labels, step)))
    return std::numeric_limits<S>::infinity();
  S scaled[3];
  for (size_t i = 0; i < 3; ++i) scaled[i] = static_cast<S>(step[i]) * core_.scale[i];
  moveBy(scaled);
  return error();
}

template <class Mesh>
double MergedPlace<Mesh>::squaredLength() const {
  double square = 0;
  for (size_t i = 0; i < 3; ++i) {
    const auto d =
        static_cast<double>((mesh_.values(v_)[i] - mesh_.values(u_)[i]) * core_.scale[i]);
    square += d * d;
  }
  return square;
}

template <class Mesh>
auto MergedPlace<Mesh>::roundingOfPlanes() const -> S {
  return static_cast<S>(kSamePlane * std::sqrt(squaredLength())) * core_.inverse_scale[0];
}

template <class Mesh>
bool MergedPlace<Mesh>::putOnPlanes(const AxisPlanes<S>& planes) {
  const double square = squaredLength();
  S step[3] = {0, 0, 0};
  bool moves = false;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<size_t>(axis);
    const S off = (planes.at(axis) - values_[i]) * core_.scale[i];
    const double most = planes.hasAll(axis) ? kNearPlane : kNearPlanes;
    const auto far = static_cast<double>(off);
    stays_[i] = planes.has(axis) && far * far <= most * most * square;
    if (!stays_[i]) continue;
    plane_[i] = planes.at(axis);
    step[i] = off;
    moves |= values_[i] != plane_[i];
  }
  if (moves) moveBy(step);
  return moves;
}

// A value that is not finite has no part in a mean: there the nearest corner's is taken, so that
// such places do not grow. Weights add up to 1 but for rounding, by which a mean could leave
// the corners' range.
template <class Mesh>
void MergedPlace<Mesh>::interpolateCarried(const Stars& stars) {
  const double x[3] = {at(0), at(1), at(2)};
  double best = -1e301, weights[4] = {1, 0, 0, 0};
  uint32_t corners[4] = {u_, u_, u_, u_};
  for (const Star* star : {&stars.ring, &stars.u, &stars.v}) {
    if (best >= 0) break;  // x lies in that cell
    const uint32_t centre = star == &stars.v ? v_ : u_;
    const NearestCell nearest =
        nearestCell(x, mesh_.allValues(), mesh_.valueStride(), static_cast<double>(core_.scale[0]),
                    centre, star->begin(), star->size());
    if (!(nearest.least > best)) continue;
    best = nearest.least;
    corners[0] = centre;
    std::copy_n((*star)[nearest.place].t, 3, corners + 1);
  }
  double p[4][3];
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) p[k][i] = static_cast<double>(mesh_.values(corners[k])[i]);
  clampedWeights(p, x, weights);
  const auto nearest = static_cast<size_t>(std::max_element(weights, weights + 4) - weights);
  for (int i = core_.plan.dimension; i < core_.plan.values; ++i) {
    double sum = 0;
    S there[4];
    for (int k = 0; k < 4; ++k) {
      there[k] = mesh_.values(corners[k])[i];
      sum += weights[k] * static_cast<double>(there[k]);
    }
    const S mean = static_cast<S>(sum);
    const auto [least, most] = std::minmax({there[0], there[1], there[2], there[3]});
    values_[static_cast<size_t>(i)] =
        std::isfinite(mean) ? std::clamp(mean, least, most) : there[nearest];
  }
}

template class MergedPlace<Window<float>>;
template class MergedPlace<Window<double>>;
template class MergedPlace<Patch<float>>;
template class MergedPlace<Patch<double>>;

}  // namespace tetstream
