#include "error_sample.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "barycentric.h"
#include "mix.h"
#include "outside_points.h"
#include "vector3.h"

namespace tetstream {

namespace {

// Of meshes up to so many cells all are looked at; of larger ones fewer, one of so many at least.
constexpr int64_t kCellsOfAll = 1 << 16;
constexpr int64_t kMostStep = 16, kUnknownStep = 4;
// Cells of a window for one point that waits. Streams of several windows have many together, and
// every cell that leaves is looked up among those.
constexpr size_t kCellsPerSampled = 16, kCellsPerSampledOfLong = 64;
// Points that wait at most: few of a small window, under a budget of memory fewer still, and of
// many fields.
constexpr size_t kFewest = 64, kFew = 2048, kMost = 16384, kMostBytes = 1 << 20;
// Standard errors of the mean of squares that are added to it.
constexpr double kChance = 1;
// And of what points have met by chance, before the rest counts as missed.
constexpr double kChanceToMiss = 2;
// What is told is more by this than what was measured: at vertices, where somebody may look for
// errors, they are larger than between them; and of a mesh of few cells most vertices are on the
// boundary, where they are largest.
constexpr double kMargin = 1.15, kMarginOfFew = 4.5;
constexpr double kMeanShare = 2;  // of a cell: one by volume, one by number
// In the window's units, so that sums are within reach of float32.
constexpr double kLargestVolume = 1e25;
// Rounding may have put a point on a face outside of both cells.
constexpr double kOutside = 1e-6;
// Of the error that is allowed: what is measured later may be more.
constexpr double kAim = 0.95;
// Of what is left of its square, what a pass may make: of few cells more may be real than is told.
constexpr double kWay = 0.65;
// Of the square of what is asked for: where quadrics tell less it is not measured.
constexpr double kFar = 1.0 / 16;
// Of what is asked for: more than this quadrics may not tell, whatever is measured.
constexpr double kMostTimes = 4;
// Where more is left of the square, another pass pays.
constexpr double kWorthGoingOn = 0.2;
constexpr int kMostBins = 256;  // along an axis
constexpr double kWider = 1.3;

// Those of a point of a cell, each as likely.
void placeByChance(uint64_t number, double w[4]) {
  double cuts[3];
  for (double& cut : cuts) cut = uniform(number = mix(~number));
  std::sort(cuts, cuts + 3);
  w[0] = cuts[0];
  w[1] = cuts[1] - cuts[0];
  w[2] = cuts[2] - cuts[1];
  w[3] = 1 - cuts[2];
}

double square(double x) {
  return x * x;
}

bool isFinite(const double x[3]) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

// 0 of what lies beyond the window's units.
double volumeOf(const double corners[4][3]) {
  if (!std::all_of(corners, corners + 4, isFinite)) return 0;
  const double volume = std::fabs(sixVolume(corners)) / 6;
  return volume < kLargestVolume ? volume : kLargestVolume;  // also where products overflow
}

int64_t stepFor(int64_t cells) {
  return cells < 0 ? kUnknownStep : std::clamp<int64_t>(cells / kCellsOfAll, 1, kMostStep);
}

}  // namespace

template <class S>
size_t ErrorSample<S>::roomFor(size_t cells) const {
  const bool has_budget = core_.options.memory_bytes > 0;
  const size_t most = kMostBytes / Core<S>::sampledBytes(core_.plan.dimension);
  const bool is_long = core_.stream_cells > static_cast<int64_t>(cells);
  const size_t per_point = has_budget ? Core<S>::kCellsPerSampledOfBudget
                           : is_long  ? kCellsPerSampledOfLong
                                      : kCellsPerSampled;
  return std::min(std::clamp(cells / per_point, has_budget ? kFewest : kFew, kMost),
                  std::max(most, kFewest));
}

template <class S>
ErrorSample<S>::ErrorSample(Core<S>& core, Account& account, size_t cells)
    : core_(core),
      points_(account),
      weights_(account),
      begin_(account),
      order_(account),
      places_(account),
      room_(roomFor(cells)) {
  points_.resize(room_ * dimension());
  weights_.resize(room_);
  begin_.resize(2 * room_ + 2);
  order_.resize(room_);
  places_.resize(3 * room_);
}

template <class S>
void ErrorSample<S>::take(uint32_t first, uint32_t end) {
  const auto step = static_cast<uint32_t>(stepFor(core_.stream_cells));
  cells_ += end - first;
  double corners[4][3];
  for (uint64_t c = first; c < end; c += step) {
    const uint64_t number = ++blocks_;
    const auto cell = static_cast<uint32_t>(c + mix(number) % step);
    if (cell >= end || !core_.window.mesh.isLive(cell)) continue;
    cornersInUnits(core_, cell, corners);
    placeByTurns(cell, number, step * volumeOf(corners));
  }
}

// A cell's share is its volume in that of the mean, and one for the cell. Shares add up until a
// point is due; a cell of more than that has one of its own.
template <class S>
void ErrorSample<S>::placeByTurns(uint32_t cell, uint64_t number, double volume) {
  if (!(volume > 0)) return;
  ++looked_at_;
  volume_ += volume;
  const double share = 1 + volume / volume_ * static_cast<double>(looked_at_);
  if (share >= stride_) return placeIn(cell, number, volume);
  due_ += share;
  if (due_ < stride_) return;
  due_ -= stride_;
  placeIn(cell, number, volume * (stride_ / share));
}

template <class S>
void ErrorSample<S>::placeIn(uint32_t cell, uint64_t number, double weight) {
  if (count_ == room_) thinOut();
  double w[4];
  placeByChance(number, w);
  const uint32_t* v = core_.window.mesh.corners(cell);
  for (size_t i = 0; i < dimension(); ++i) {
    double value = 0;
    for (int k = 0; k < 4; ++k) value += w[k] * static_cast<double>(core_.window.values(v[k])[i]);
    points_[count_ * dimension() + i] = static_cast<S>(value);
  }
  weights_[count_++] = static_cast<float>(weight);
}

// Every other point stays, for two.
template <class S>
void ErrorSample<S>::thinOut() {
  stride_ = stride_ > 0 ? 2 * stride_ : 2 * kMeanShare;
  for (size_t i = 0; i < count_; ++i) weights_[i] = i % 2 == 0 ? 2 * weights_[i] : 0;
  compact();
}

template <class S>
void ErrorSample<S>::compact() {
  size_t kept = 0;
  for (size_t i = 0; i < count_; ++i) {
    if (!(weights_[i] > 0)) continue;
    if (kept < i) std::copy_n(point(i), dimension(), points_.data() + kept * dimension());
    weights_[kept++] = weights_[i];
  }
  count_ = kept;
}

template <class S>
void ErrorSample<S>::scaled(const S x[3], double out[3]) const {
  for (int i = 0; i < 3; ++i)
    out[i] = static_cast<double>(core_.scale[0]) * static_cast<double>(x[i]);
}

// About one for a point, and never more than there is room for.
template <class S>
void ErrorSample<S>::chooseBins() {
  double high[3], x[3], longest = 0, volume = 1;
  std::fill_n(low_, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
  for (size_t p = 0; p < count_; ++p) {
    scaled(point(p), x);
    for (int i = 0; i < 3; ++i) {
      low_[i] = std::min(low_[i], x[i]);
      high[i] = std::max(high[i], x[i]);
    }
  }
  for (int i = 0; i < 3; ++i) longest = std::max(longest, high[i] - low_[i]);
  for (int i = 0; i < 3; ++i) volume *= std::max(high[i] - low_[i], longest / kMostBins);
  double side = std::cbrt(volume / static_cast<double>(std::max<size_t>(count_, 1)));
  do {
    for (int i = 0; i < 3; ++i) {
      const double extent = high[i] - low_[i], bins = side > 0 ? std::floor(extent / side) : 1;
      bins_[i] = static_cast<size_t>(std::clamp(bins, 1.0, double{kMostBins}));
      bins_by_unit_[i] = extent > 0 ? static_cast<double>(bins_[i]) / extent : 0;
    }
    side *= kWider;
  } while (bins_[0] * bins_[1] * bins_[2] + 1 >= begin_.size());
}

// Along an axis; places beyond its ends count as there, and those that are no numbers, as where
// the window's units are too small for what comes.
template <class S>
size_t ErrorSample<S>::binAlong(int axis, S x) const {
  const double place = (static_cast<double>(core_.scale[0]) * static_cast<double>(x) - low_[axis]) *
                       bins_by_unit_[axis];
  const auto last = static_cast<double>(bins_[axis] - 1);
  return place > 0 ? static_cast<size_t>(std::min(place, last)) : 0;
}

template <class S>
size_t ErrorSample<S>::binOf(const S x[3]) const {
  return (binAlong(0, x[0]) * bins_[1] + binAlong(1, x[1])) * bins_[2] + binAlong(2, x[2]);
}

template <class S>
void ErrorSample<S>::sort() {
  if (count_ == 0) return;
  chooseBins();
  const size_t bins = bins_[0] * bins_[1] * bins_[2];
  std::fill_n(begin_.data(), bins + 2, 0u);
  for (size_t p = 0; p < count_; ++p) ++begin_[binOf(point(p)) + 2];
  for (size_t b = 1; b <= bins; ++b) begin_[b + 1] += begin_[b];
  for (size_t p = 0; p < count_; ++p) {
    const size_t at = begin_[binOf(point(p)) + 1]++;
    order_[at] = static_cast<uint32_t>(p);
    std::copy_n(point(p), 3, places_.data() + 3 * at);
  }
}

// visitOne(point, weights) for each that is not gone, nor was found before, and lies in the cell.
template <class S>
template <class Visit>
void ErrorSample<S>::visit(uint32_t cell, Visit visitOne) const {
  if (count_ == 0) return;
  const uint32_t* const v = core_.window.mesh.corners(cell);
  S low[3], high[3];
  size_t first[3], last[3];
  for (int i = 0; i < 3; ++i) {
    const auto at = [&](int k) { return core_.window.values(v[k])[i]; };
    low[i] = std::min(std::min(at(0), at(1)), std::min(at(2), at(3)));
    high[i] = std::max(std::max(at(0), at(1)), std::max(at(2), at(3)));
    first[i] = binAlong(i, low[i]);
    last[i] = binAlong(i, high[i]);
  }
  const auto isInBox = [&](const S* x) {
    return x[0] >= low[0] && x[0] <= high[0] && x[1] >= low[1] && x[1] <= high[1] &&
           x[2] >= low[2] && x[2] <= high[2];
  };
  CellFrame frame;
  bool is_set = false;
  for (size_t a = first[0]; a <= last[0]; ++a)
    for (size_t b = first[1]; b <= last[1]; ++b) {
      const size_t row = (a * bins_[1] + b) * bins_[2];
      const uint32_t end = begin_[row + last[2] + 1];
      for (uint32_t k = begin_[row + first[2]]; k < end; ++k) {
        const S* const place = places_.data() + 3 * size_t{k};
        const uint32_t p = order_[k];
        if (!isInBox(place) || !(weights_[p] > 0)) continue;
        if (!std::exchange(is_set, true)) {
          double corners[4][3];
          cornersInUnits(core_, cell, corners);
          frame.set(corners[0]);
        }
        double x[3], w[4];
        scaled(place, x);
        frame.weights(x, w);
        if (std::min({w[0], w[1], w[2], w[3]}) >= -kOutside) visitOne(p, w);
      }
    }
}

// That smooth fields have beside others counts where edges are chosen, not for what is told.
template <class S>
double ErrorSample<S>::weightFound(size_t component) const {
  const std::vector<double>& found = core_.balance.fields;
  const auto field = static_cast<size_t>(core_.plan.measured_column[component]);
  return found.empty() ? 1 : found[field];
}

// Of the point, between what the fields are in the cell and what they were in the input; the
// window's units.
template <class S>
double ErrorSample<S>::squaredError(size_t i, uint32_t cell, const double weights[4]) const {
  const uint32_t* v = core_.window.mesh.corners(cell);
  double sum = 0;
  for (size_t k = 3; k < dimension(); ++k) {
    double value = 0;
    for (int j = 0; j < 4; ++j)
      value += weights[j] * static_cast<double>(core_.window.values(v[j])[k]);
    const double error =
        static_cast<double>(core_.scale[k]) * (value - static_cast<double>(point(i)[k]));
    sum += error * error / weightFound(k - 3);
  }
  return sum;
}

// Of its corners: the error that quadrics told where each stands, of the volume it stands for.
template <class S>
void ErrorSample<S>::toldAt(uint32_t cell, double told[4]) const {
  const int w = core_.window.shape().quadric - 2;
  for (int j = 0; j < 4; ++j) {
    const uint32_t v = core_.window.mesh.corners(cell)[j];
    const auto volume = static_cast<double>(core_.window.quadric(v)[w]);
    told[j] = volume > 0 ? static_cast<double>(core_.window.error(v)) / volume : 0;
  }
}

// seen(point): each that lies in the cell.
template <class S>
template <class Seen>
void ErrorSample<S>::addCell(Sum& sum, uint32_t cell, Seen seen) const {
  double corners[4][3], told[4];
  cornersInUnits(core_, cell, corners);
  toldAt(cell, told);
  sum.told_of_all += volumeOf(corners) / 4 * (told[0] + told[1] + told[2] + told[3]);
  visit(cell, [&](size_t i, const double* w) {
    addPoint(sum, i, cell, w, told);
    seen(i);
  });
}

template <class S>
void ErrorSample<S>::addPoint(Sum& sum, size_t i, uint32_t cell, const double w[4],
                              const double told[4]) const {
  const auto volume = static_cast<double>(weights_[i]);
  const double error = volume * squaredError(i, cell, w);
  const double by_quadrics =
      volume * (w[0] * told[0] + w[1] * told[1] + w[2] * told[2] + w[3] * told[3]);
  sum.weight += volume;
  sum.error += error;
  sum.square += square(error);
  sum.told += by_quadrics;
  sum.told_square += square(by_quadrics);
}

template <class S>
template <class Visit>
void ErrorSample<S>::forLive(Visit visitCell) const {
  const Topology& mesh = core_.window.mesh;
  for (uint32_t c = 0; c < mesh.cellEnd(); ++c)
    if (mesh.isLive(c)) visitCell(c);
}

// Of points that lie in no cell any more, since the boundary has moved: all that were not found.
template <class S>
void ErrorSample<S>::addOutside(Sum& sum) {
  OutsidePoints<S> outside(core_);
  for (size_t i = 0; i < count_; ++i) {
    if (!(weights_[i] > 0)) continue;
    double place[3];
    scaled(point(i), place);
    outside.add(static_cast<uint32_t>(i), place);
  }
  outside.forNearest([&](const typename OutsidePoints<S>::Found& found) {
    double told[4];
    toldAt(found.cell, told);
    addPoint(sum, found.point, found.cell, found.weights, told);
  });
}

// note: what is outside when cells leave is measured then, for what is nearest may leave; all cells
// at once, if they do.
template <class S>
void ErrorSample<S>::startLeaving(bool all) {
  const auto markFound = [this](size_t i) { weights_[i] = -weights_[i]; };
  sort();
  forLive([&](uint32_t c) {
    if (all)
      addCell(sum_, c, markFound);
    else
      visit(c, [&](size_t i, const double*) { markFound(i); });
  });
  addOutside(sum_);
  for (size_t i = 0; i < count_; ++i) weights_[i] = all ? 0 : std::max(-weights_[i], 0.0f);
  is_measured_ = all;
}

template <class S>
void ErrorSample<S>::leave(uint32_t cell) {
  if (!is_measured_) addCell(sum_, cell, [&](size_t i) { weights_[i] = 0; });
}

template <class S>
void ErrorSample<S>::endLeaving() {
  compact();
}

template <class S>
void ErrorSample<S>::rescale(double factor) {
  sum_.error *= factor;
  sum_.square *= factor * factor;
  sum_.told *= factor;
  sum_.told_square *= factor * factor;
  sum_.told_of_all *= factor;
}

// Of what quadrics tell of all cells, what points have not come upon; chance may have left out
// some.
template <class S>
double ErrorSample<S>::missedShare(const Sum& sum) const {
  if (!(sum.told_of_all > 0)) return 0;
  const double met = (sum.told + kChanceToMiss * std::sqrt(sum.told_square)) / sum.told_of_all;
  return std::max(0.0, 1 - met);
}

// No less than was measured, and no more than quadrics tell besides. What was missed counts as the
// rest, which is measured, the less of it there is: a little of it lies outside the boundary as it
// is now, where quadrics tell of that.
template <class S>
double ErrorSample<S>::percentOf(const Sum& sum) const {
  const double told = tetstream::percentOf(core_, core_.tally.error);
  if (!(sum.weight > 0)) return told;
  const double measured = 100 * std::sqrt(sum.error / sum.weight) / core_.extent;
  const double chance =
      100 * std::sqrt(kChance * std::sqrt(sum.square) / sum.weight) / core_.extent;
  const double margin = kMargin * (1 + kMarginOfFew / std::cbrt(static_cast<double>(cells_)));
  const double missed = missedShare(sum);
  const double likely =
      square(margin) * (1 + missed) * (square(measured) + square(chance)) + square(missed * told);
  return std::max(measured, std::min(told, std::sqrt(likely)));
}

template <class S>
double ErrorSample<S>::percentNow() {
  Sum sum = sum_;
  sort();
  forLive([&](uint32_t c) { addCell(sum, c, [this](size_t i) { weights_[i] = -weights_[i]; }); });
  addOutside(sum);
  for (size_t i = 0; i < count_; ++i) weights_[i] = std::fabs(weights_[i]);
  return percentOf(sum);
}

// Quadrics may tell what is allowed in any case, but where the error is more than they tell. Beyond
// that a pass may make by them a part of what is left by measure, which is less as a rule.
template <class S>
bool ErrorSample<S>::limitError() {
  const double asked = square(core_.options.error), allowed = square(kAim) * asked;
  const double told = square(tetstream::percentOf(core_, core_.tally.error));
  const double now = told <= kFar * asked ? told : square(percentNow());
  const double left = std::max(allowed - now, 0.0);
  const double limit =
      now > told ? told + kWay * left * (told / now) : std::max(asked, told + kWay * left);
  core_.error_limit = errorOf(core_, std::sqrt(std::min(limit, square(kMostTimes) * asked)));
  made_ = core_.tally.error;
  return left > kWorthGoingOn * allowed && limit > told;
}

// One that has made less than half of what it might leaves the limit as it is.
template <class S>
bool ErrorSample<S>::limitErrorAfterPass() {
  const bool is_small = 2 * (core_.tally.error - made_) < core_.error_limit - made_;
  return (is_small && !core_.tally.error_reached) || limitError();
}

template class ErrorSample<float>;
template class ErrorSample<double>;

}  // namespace tetstream
