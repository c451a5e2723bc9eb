#include "sweep_bounds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "pilot.h"
#include "settled.h"

namespace tetstream {

// From pass to pass; larger steps make the tiles uneven, smaller ones take time.
constexpr double kLeastStep = 1.15, kLargestStep = 4;
// While the law of kDecay says that the goal is farther. A pass that leaves less than a third of
// the cells leaves fine seams between coarse tiles.
constexpr double kLargestStride = 16;
// Where the errors that were made bear no more.
constexpr double kGuardedStep = 2;
// A goal that is farther than so many times it, with fewer edges than this share refused for their
// error alone, is out of reach: what is left is not legal, and the few edges that are would be
// spent for nothing. Where both regions and fields are to be kept it is nearly so with any share,
// and for a goal that is near, too: spheres in a block, as cells of a grid have them, lost 4.8 for
// 2.1 % of the field and 9 for 0.7 % of the boundary for the last 4 % of the cells.
constexpr double kNear = 1.25, kFewAsLarge = 0.15;
// Where the boundary counts a 128th it may be 11 times as far off for the same error. Of squared
// errors that are allowed this power of its part is left: 1.8 times as far, the fields a sixth.
// Blocks that touch along edges were off by a block for 6 % of the cells.
constexpr double kPartAllowed = 0.75;
// Of no more cells the mean error tells nothing, and the largest is none for the last few.
constexpr int64_t kFewCells = 1000, kFewest = 48;
// With high effort: the smaller steps are, the more nearly edges are taken in the order of
// their errors, and the more often quadrics are made anew.
constexpr double kCarefulStep = 2;
// Towards the goal, of a mesh held whole of which less than a third is left: passes cost little
// then, and each renews the quadrics. With it meshes at 0.1 and 0.02 had 0.97 and 0.93 times the
// error, in 1.03 times the time; steps of 2 gain little, and from a larger part on they take up to
// twice the time.
constexpr double kNearStep = 1.5;
constexpr int64_t kNearGoals = 6, kPartNear = 3;
// Of the first pass, which still finds all cells that cost next to nothing.
constexpr double kLargestStart = 40;
// Cells that a pass takes, for each vertex that has an edge below its bound: at first, and limits
// of what is learnt from a pass for the next.
constexpr double kFirstYield = 2, kLeastYield = 1, kLargestYield = 3;
// At half of the cells this share of the vertices has had its best edges below the bound, at least,
// and so on by the law of kDecay: on real meshes reduced to 0.5, 0.1 and 0.02 the first bound that
// follows was 1 to 1e6 times, in the median 300 times, below the last. With a limit on the error
// the share of those below the first bound.
constexpr double kFirstShare = 0.4, kHalf = 0.5, kFirstShareToError = 0.01;
constexpr double kLargestBound = std::numeric_limits<float>::max();  // every finite error is below

template <class S>
double SweepBounds<S>::start(const Goal& goal, double unit) {
  unit_ = unit;
  yield_ = kFirstYield;
  error_before_ = core_.tally.error;
  const bool is_by_error = std::isfinite(core_.error_limit) && !core_.options.countsCells();
  const bool must_reach = goal.last && core_.options.last_resort && !is_by_error;
  reach_ = must_reach ? &kWorth : nullptr;
  return std::min(goal.first_bound * unit / std::pow(goal.step, goal.approaches), kLargestBound);
}

template <class S>
void SweepBounds<S>::learn(int64_t taken, int64_t looking) {
  if (looking > 0)
    yield_ = std::clamp(static_cast<double>(taken) / static_cast<double>(looking), kLeastYield,
                        kLargestYield);
}

// Less than one cell in so many, with more to go; passes of most fields take an eighth. Of fewer
// cells it tells nothing, nor towards a limit on the error, to which steps become small. Bodies
// without fields gain nothing by it.
constexpr int64_t kFewTaken = 64, kLeastToTell = 1024;

template <class S>
bool SweepBounds<S>::areStuck(int64_t taken, const Goal& goal) const {
  const int64_t live = core_.window.liveCells();
  const bool tells =
      core_.plan.measures() && !std::isfinite(core_.error_limit) && live >= kLeastToTell;
  return tells && kFewTaken * taken < live && kFewTaken * goal.left(live) > live;
}

// Errors for which a law holds count from here to the goal by this factor, at most.
template <class S>
double SweepBounds<S>::distance(double share_left, const Goal& goal) const {
  const auto free = static_cast<double>(core_.window.liveCells() - goal.fixed);
  const auto wanted = static_cast<double>(std::max<int64_t>(goal.cells - goal.fixed, 1));
  return std::pow(std::max(share_left * free / wanted, 1.0), 1 / kDecay);
}

template <class S>
double SweepBounds<S>::first(std::vector<float>& errors, const Goal& goal) const {
  if (errors.empty()) return std::numeric_limits<float>::min();
  const bool to_error = std::isfinite(core_.error_limit);
  const double share = to_error ? kFirstShareToError : kFirstShare;
  const auto place = static_cast<size_t>(share * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(place),
                   errors.end());
  const double bound =
      errors[place] * (to_error ? 1 : std::min(distance(kHalf, goal), kLargestStart));
  return std::clamp<double>(bound, std::numeric_limits<float>::min(), kLargestBound);  // never 0
}

// The bound below which there are so many edges that a pass should take these cells.
template <class S>
double SweepBounds<S>::boundToTake(double cells) const {
  uint32_t* const leasts = core_.window.scratch();
  size_t count = 0;
  for (uint32_t v = 0; v < core_.window.mesh.vertexEnd(); ++v) {
    if (!core_.window.isFree(v)) continue;
    leasts[count++] = std::bit_cast<uint32_t>(settledOf(core_.window, v).least);
  }
  const auto place = static_cast<size_t>(cells / yield_);
  if (place >= count) return std::numeric_limits<double>::infinity();
  std::nth_element(leasts, leasts + place, leasts + count);  // bits order as the errors do
  return static_cast<double>(std::bit_cast<float>(leasts[place]));
}

// The squared error that this goal made rises as n^(-4/3).
template <class S>
double SweepBounds<S>::stepToError(double limit) const {
  const double made = core_.tally.error - error_before_;
  if (!(made > 0)) return std::numeric_limits<double>::infinity();
  return std::pow(std::max(limit - error_before_, 0.0) / made, 7.0 / 4);
}

template <class S>
double SweepBounds<S>::onTheWay(double bound, const Goal& goal) const {
  const double step = std::min(goal.step, stepToError(core_.error_limit));
  return bound * std::max(step, kLeastStep);
}

// note: of meshes with regions only what was parked takes them: of grains held whole bodies lost
// their corners.
template <class S>
bool SweepBounds<S>::isNear(const Goal& goal) const {
  const int64_t live = core_.window.liveCells();
  return core_.options.eases_in && core_.holdsAll() && (!core_.interfaces || core_.holds_rest) &&
         live < kNearGoals * goal.cells && kPartNear * live < core_.stream_cells;
}

template <class S>
double SweepBounds<S>::wanted(double bound, const Goal& goal) const {
  const auto cells = static_cast<double>(core_.window.liveCells() - goal.cells);
  const double by_count = boundToTake(std::max(cells, 0.0)) / bound;
  const double by_error = stepToError(std::min(goal.most_error, core_.error_limit));
  const bool is_careful = core_.options.effort == Effort::kHigh;
  double step = std::min({by_count, by_error, is_careful ? kCarefulStep : kLargestStep});
  if (!is_careful && !std::isfinite(core_.error_limit))
    step = std::max(step, std::min({distance(1, goal), by_error, kLargestStride}));
  if (isNear(goal)) step = std::min(step, kNearStep);
  return std::min(bound * std::max(step, kLeastStep), kLargestBound);
}

template <class S>
double SweepBounds<S>::next(double bound, double wanted) const {
  const double guarded = std::max(errorIn(kFree, 1) * unit_, kGuardedStep * bound);
  const double next = std::min(wanted, guarded), most = limit() * unit_;
  if (next <= most) return next;
  return most > kLeastStep * bound ? most : bound;
}

// What the squared errors of a field count at most, given and found (field_weights.h): what is
// allowed in percent of its range counts as much. note: not beside regions, whose body would pay
// for a few cells more, nor where steps are guarded: of several fields they would be larger.
template <class S>
double SweepBounds<S>::heaviest() const {
  if (core_.interfaces) return 1;
  const std::vector<double>& found = core_.balance.fields;
  double most = 0;
  for (size_t i = 0; i < core_.plan.weights.size(); ++i) {
    const auto field = static_cast<size_t>(core_.plan.measured_column[i]);
    most = std::max(most, core_.plan.weights[i] * (found.empty() ? 1 : found[field]));
  }
  return most > 0 ? most : 1;
}

template <class S>
double SweepBounds<S>::errorIn(const Reach& reach, double weight) const {
  const auto vertices =
      static_cast<double>(core_.reached) - static_cast<double>(core_.tally.collapses);
  const double square = reach.times * reach.times;
  return std::max(weight * errorOf(core_, reach.percent), square * core_.tally.error) /
         std::max(vertices, 1.0);
}

template <class S>
double SweepBounds<S>::limit() const {
  return reach_ ? partAllowed() * errorIn(*reach_, heaviest())
                : std::numeric_limits<double>::infinity();
}

template <class S>
double SweepBounds<S>::mostPercent() const {
  return reach_ ? std::sqrt(partAllowed()) * reach_->percent : 0;
}

// note: all of it beside regions: walls of them would be left with several times the target.
template <class S>
double SweepBounds<S>::partAllowed() const {
  return core_.interfaces ? 1 : std::pow(core_.balance.outer, kPartAllowed);
}

// Null: no farther.
template <class S>
auto SweepBounds<S>::widest(const Goal& goal, const Refused& refused) const -> const Reach* {
  const int64_t live = core_.window.liveCells();
  const Reach* const most = core_.interfaces && core_.plan.measures() ? &kWorthBeside : &kLastWorth;
  if (static_cast<double>(live) <= kNear * static_cast<double>(goal.cells)) return most;
  const bool are_large =
      static_cast<double>(refused.as_large) > kFewAsLarge * static_cast<double>(refused.all);
  return are_large || !(core_.interfaces || live > kFewCells) ? most : nullptr;
}

template <class S>
bool SweepBounds<S>::widen(const Goal& goal, const Refused& refused) {
  if (!reach_) return false;
  const Reach* const wider = widest(goal, refused);
  const bool is_last = reach_ == &kLastWorth && !core_.interfaces;
  if (is_last && core_.window.liveCells() <= kFewest)
    reach_ = nullptr;
  else if (wider && wider->percent > reach_->percent)
    reach_ = wider;
  else
    return false;
  return true;
}

template class SweepBounds<float>;
template class SweepBounds<double>;

}  // namespace tetstream
