#include "metric.h"

#include <algorithm>
#include <limits>

#include "error_sample.h"
#include "field_weights.h"
#include "one_number.h"
#include "orient.h"
#include "pilot.h"
#include "settled.h"

namespace tetstream {

// Scales follow a growing box in steps: smaller ones would redo the quadrics at every window.
constexpr double kRescaleStep = 1.25;

template <class S>
Metric<S>::Metric(Core<S>& core)
    : core_(core),
      box_known_(core.plan.schema.hasBox()),
      low_(static_cast<size_t>(core.plan.dimension), std::numeric_limits<double>::infinity()),
      high_(low_.size(), -std::numeric_limits<double>::infinity()),
      used_range_(low_.size(), -1) {
  if (!box_known_) return;
  const Schema& schema = core.plan.schema;
  size_t in_box = 3;
  for (size_t f = 0; f < schema.fields.size(); ++f) {
    const ColumnPlan& place = core.plan.fields[f];
    for (int i = 0; i < schema.fields[f].components; ++i, ++in_box) {
      if (place.treatment != Treatment::kMeasured) continue;
      low_[static_cast<size_t>(place.offset + i)] = schema.box_min[in_box];
      high_[static_cast<size_t>(place.offset + i)] = schema.box_max[in_box];
    }
  }
  for (size_t i = 0; i < 3; ++i) {
    low_[i] = schema.box_min[i];
    high_[i] = schema.box_max[i];
  }
  for (size_t i = 0; i < low_.size(); ++i)
    if (!(low_[i] <= high_[i]) || !std::isfinite(high_[i] - low_[i])) box_known_ = false;
}

// Only vertices of cells count: what a batch brings beyond them must not matter yet.
template <class S>
void Metric<S>::growBox(uint32_t first, uint32_t end) {
  for (uint32_t c = first; c < end; ++c)
    for (int j = 0; j < 4; ++j) {
      const S* x = core_.window.values(core_.window.mesh.corners(c)[j]);
      for (size_t i = 0; i < low_.size(); ++i) {
        low_[i] = std::min(low_[i], static_cast<double>(x[i]));
        high_[i] = std::max(high_[i], static_cast<double>(x[i]));
      }
    }
}

// Whether a vertex whose cells are still to come, or new, is not in the box that the stream told.
template <class S>
bool Metric<S>::liesOutside() const {
  const Topology& mesh = core_.window.mesh;
  for (uint32_t v = 0; v < mesh.vertexEnd(); ++v) {
    if (mesh.vertexFlags(v) & kResolved) continue;
    const S* x = core_.window.values(v);
    for (size_t i = 0; i < low_.size(); ++i)
      if (static_cast<double>(x[i]) < low_[i] || static_cast<double>(x[i]) > high_[i]) return true;
  }
  return false;
}

template <class S>
double Metric<S>::extent() const {
  return std::max({high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]});
}

// Of all components of the field; 0 of one that is constant.
template <class S>
double Metric<S>::rangeOf(size_t component) const {
  const std::vector<int>& column = core_.plan.measured_column;
  double widest = 0, largest = 0;  // the first scales, so that no square overflows
  for (size_t i = 3; i < low_.size(); ++i)
    if (column[i - 3] == column[component - 3]) {
      widest = std::max(widest, high_[i] - low_[i]);
      largest = std::max({largest, std::fabs(low_[i]), std::fabs(high_[i])});
    }
  if (!(widest > 0)) return 0;
  double sum = 0;
  bool is_constant = true;
  for (size_t i = 3; i < low_.size(); ++i)
    if (column[i - 3] == column[component - 3]) {
      const double r = (high_[i] - low_[i]) / widest;
      sum += r * r;
      is_constant &= isOneNumber(low_[i], high_[i], largest, typeOf(component));
    }
  return is_constant ? 0 : widest * std::sqrt(sum);
}

template <class S>
void Metric<S>::chooseLengthUnit(uint32_t first, uint32_t end) {
  double longest = 0, sum = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (uint32_t c = first; c < end; ++c) {
      const S* a = core_.window.values(core_.window.mesh.corners(c)[0]);
      const S* b = core_.window.values(core_.window.mesh.corners(c)[1]);
      double largest = 0;
      for (int i = 0; i < 3; ++i)
        largest =
            std::max(largest, std::fabs(static_cast<double>(b[i]) - static_cast<double>(a[i])));
      if (pass == 0)
        longest = std::max(longest, largest);
      else
        sum += largest / longest;
    }
  if (!(longest > 0) || end == first) return;
  int exponent;
  std::frexp(longest * (sum / (end - first)), &exponent);
  length_unit_ = std::ldexp(1.0, std::clamp(exponent, -1000, 1000));
  unit_known_ = true;
}

template <class S>
std::vector<double> Metric<S>::ranges() const {
  std::vector<double> range(low_.size());
  for (size_t i = 0; i < range.size(); ++i) range[i] = i < 3 ? extent() : rangeOf(i);
  return range;
}

template <class S>
ScalarType Metric<S>::typeOf(size_t component) const {
  const auto field = static_cast<size_t>(core_.plan.measured_column[component - 3]);
  return core_.plan.schema.fields[field].type;
}

// The one that was given, and what was found.
template <class S>
double Metric<S>::weightOf(size_t component) const {
  const std::vector<double>& found = core_.balance.fields;
  const auto field = static_cast<size_t>(core_.plan.measured_column[component - 3]);
  return core_.plan.weights[component - 3] * (found.empty() ? 1 : found[field]);
}

template <class S>
void Metric<S>::updateScales() {
  const std::vector<double> range = ranges();
  bool grown = false;
  for (size_t i = 0; i < range.size(); ++i)
    grown =
        grown ||
        (used_range_[i] < 0 ? true : range[i] > (box_known_ ? 1 : kRescaleStep) * used_range_[i]);
  if (!grown) return;
  const bool first_time = used_range_[0] < 0;
  std::vector<S> factor(range.size(), S(1));
  for (size_t i = 0; i < range.size(); ++i) {
    const double weight = i < 3 ? 1 : std::sqrt(weightOf(i));
    const double size = extent() > 0 ? extent() : 1;  // all points coincide: every cell is flat
    const double unit = i < 3 ? length_unit_ : length_unit_ * (range[i] / size) / weight;
    // A range of nothing, or one that the window's numbers cannot be divided by, counts as
    // constant.
    const S given = static_cast<S>(1 / unit), inverse = static_cast<S>(unit);
    const bool usable = std::isfinite(given) && given > 0 && std::isfinite(inverse) && inverse > 0;
    const S scale = usable ? given : i < 3 ? S(1) : S(0);
    if (!first_time && core_.scale[i] > 0 && scale > 0) factor[i] = core_.scale[i] / scale;
    core_.scale[i] = scale;
    core_.inverse_scale[i] = usable ? inverse : scale;
  }
  used_range_ = range;
  noteVariations();
  fields_together_ = fieldsTogether();
  core_.extent = extent() > 0 ? extent() / length_unit_ : 1;
  const double unit_share = extent() > 0 ? length_unit_ / extent() : 1;
  core_.error_unit = unit_share * unit_share * unit_share * unit_share * unit_share;
  if (!first_time) rescaleQuadrics(factor);
}

template <class S>
void Metric<S>::noteVariations() {
  std::vector<Variation>& varies = core_.balance.varies;
  varies.assign(core_.plan.schema.fields.size(), Variation::kVaries);
  for (size_t i = 3; i < low_.size(); ++i) {
    if (core_.scale[i] > 0) continue;
    const Variation component = !(high_[i] > low_[i]) ? Variation::kConstant
                                : used_range_[i] == 0 ? Variation::kByRounding
                                                      : Variation::kOutOfReach;
    Variation& field = varies[static_cast<size_t>(core_.plan.measured_column[i - 3])];
    field = field == Variation::kVaries ? component : std::min(field, component);
  }
}

// Old quadrics get the units of new ones, and the weight that they would have there: that of the
// field whose scale grew most, so that no error made so far counts less than it should.
template <class S>
void Metric<S>::rescaleQuadrics(const std::vector<S>& factor) {
  double grown = 0;
  for (size_t i = 3; i < factor.size(); ++i)
    grown = std::max(grown, 1 / (static_cast<double>(factor[i]) * static_cast<double>(factor[i])));
  const S weight = grown > 0 && std::isfinite(static_cast<S>(grown)) ? static_cast<S>(grown) : S(1);
  const Topology& mesh = core_.window.mesh;
  for (uint32_t v = 0; v < mesh.vertexEnd(); ++v) {
    core_.kernels.rescale(factor.data(), weight, core_.plan.dimension, core_.window.quadric(v));
    if (core_.window.shape().errors) core_.window.error(v) *= static_cast<float>(weight);
    const bool has_left = (mesh.vertexFlags(v) & kWritten) && !mesh.isOfParked(v);
    if (!has_left) unsettle(core_.window, v);
  }
  core_.tally.error *= static_cast<double>(weight);
  if (core_.error_sample) core_.error_sample->rescale(static_cast<double>(weight));
  core_.rescaled *= static_cast<double>(weight);
}

// `determinant`: 6 V in the window's units.
template <class S>
double Metric<S>::volumeOf(uint32_t cell, double determinant) {
  const double volume = std::fabs(determinant) / 6;
  if (core_.plan.cell_means) core_.window.cellMeans(cell)[0] = volume;
  return volume;
}

template <class S>
void Metric<S>::lockFlat(uint32_t cell) {
  Window<S>& window = core_.window;
  for (int j = 0; j < 4; ++j) window.mesh.flagVertex(window.mesh.corners(cell)[j], kLocked);
  if (core_.plan.cell_means) window.cellMeans(cell)[0] = 0;
  ++core_.report.locked_cells;
  ++core_.locked.bad_cells;
}

// Returns the volume with that of the cell.
template <class S>
double Metric<S>::addCell(uint32_t cell, double volume) {
  Window<S>& window = core_.window;
  const uint32_t* v = window.mesh.corners(cell);
  double p[4][3];
  const S* x[4];
  S* q[4];
  for (int j = 0; j < 4; ++j) {
    positionOf(window, v[j], p[j]);
    x[j] = window.values(v[j]);
    q[j] = window.quadric(v[j]);
  }
  const int side = orientation(p[0], p[1], p[2], p[3]);
  if (side == 0) {
    window.mesh.flagCell(cell, kFlat);
    return volume;
  }
  if (side < 0) window.mesh.flagCell(cell, kNegative);
  const double determinant =
      core_.kernels.addCell(x, core_.scale.data(), core_.plan.dimension, core_.shape_weight, q);
  return volume + volumeOf(cell, determinant);
}

// Several side by side, where all have their sign beyond doubt.
template <class S>
bool Metric<S>::addLanes(uint32_t first, double* volume) {
  Window<S>& window = core_.window;
  double determinants[kCellLanes];
  if (!core_.kernels.addCells(core_.tableOf(window), window.quadric(0), window.mesh.corners(first),
                              window.mesh.corners(first), core_.scale.data(), core_.plan.dimension,
                              core_.shape_weight, determinants))
    return false;
  for (uint32_t k = 0; k < kCellLanes; ++k) {
    if (determinants[k] < 0) window.mesh.flagCell(first + k, kNegative);
    *volume += volumeOf(first + k, determinants[k]);
  }
  return true;
}

// Before anything is measured, of several fields, where the window has enough of the mesh to tell.
template <class S>
bool Metric<S>::canWeighFields(uint32_t cells) const {
  const std::vector<int>& column = core_.plan.measured_column;
  const int64_t all = core_.stream_cells;
  return core_.weighs_fields && !unit_known_ && core_.balance.fields.empty() && !column.empty() &&
         column.front() != column.back() && all >= 0 && cells >= all / kFewWindows;
}

template <class S>
void Metric<S>::prepare(uint32_t first, uint32_t end) {
  if (first == end) return;
  if (box_known_ && liesOutside()) box_known_ = false;
  if (!box_known_) growBox(first, end);
  if (canWeighFields(end)) core_.balance.fields = weightsOfFields(core_, end, ranges());
  if (!unit_known_) chooseLengthUnit(first, end);
  updateScales();
  keepRange();
  // Errors of several fields are added up: the boundary counts as much beside them as beside one.
  core_.face_weight = fields_together_ * core_.options.boundary_weight * extent() / length_unit_;
}

// Of a field's range.
constexpr double kMostBeyond = 0.25;

// Minimizers lie beyond the values they come from where a field bends: of a density, below 0. Where
// it jumps and few cells are left they would do so by most of the range, for no smaller error.
template <class S>
double Metric<S>::slackOf(size_t component) const {
  if (core_.options.field_range != FieldRange::kFree) return 0;
  if (followsPaper(core_.options.mode)) return std::numeric_limits<double>::infinity();
  return kMostBeyond * rangeOf(component);
}

// In no mode are values beyond what the output's numbers can be.
template <class S>
void Metric<S>::keepRange() {
  for (size_t i = 3; i < low_.size(); ++i) {
    const double slack = slackOf(i);
    const double largest = largestNumberOf(i);
    core_.least[i] = static_cast<S>(std::max(low_[i] - slack, -largest));
    core_.most[i] = static_cast<S>(std::min(high_[i] + slack, largest));
  }
}

// note: a window of float32 has no column of float64.
template <class S>
double Metric<S>::largestNumberOf(size_t component) const {
  return typeOf(component) == ScalarType::kFloat32
             ? std::numeric_limits<float>::max()
             : static_cast<double>(std::numeric_limits<S>::max());
}

template <class S>
void Metric<S>::addCells(uint32_t first, uint32_t end) noexcept {
  double volume = core_.volume;  // note: not there, where other threads look at what lies beside it
  for (uint32_t c = first; c < end;) {
    if (end - c >= kCellLanes && addLanes(c, &volume))
      c += kCellLanes;
    else
      volume = addCell(c++, volume);
  }
  core_.volume = volume;
}

template <class S>
void Metric<S>::settle(uint32_t first, uint32_t end) {
  for (uint32_t c = first; c < end; ++c)
    if (core_.window.mesh.cellFlags(c) & kFlat) lockFlat(c);
}

// The weights of the fields that are not constant, in the largest of them: 1 for one.
template <class S>
double Metric<S>::fieldsTogether() const {
  double sum = 0, largest = 0;
  for (size_t i = 0; i < core_.plan.weights.size(); ++i) {
    const std::vector<int>& column = core_.plan.measured_column;
    if ((i > 0 && column[i] == column[i - 1]) || !(core_.scale[i + 3] > 0)) continue;
    sum += core_.plan.weights[i];
    largest = std::max(largest, core_.plan.weights[i]);
  }
  return largest > 0 ? sum / largest : 1;
}

template class Metric<float>;
template class Metric<double>;

}  // namespace tetstream
