#include "budget.h"

#include <cmath>
#include <limits>

#include "window_size.h"

namespace tetstream {

// The first window is not simplified further than this: its own detail says little of the rest.
constexpr double kFirstRatio = 0.25;
// What a pilot says weighs as much as this share of the stream.
constexpr double kTrust = 0.2;
// Share of the cells to come that the bound leaves for the end: what is simplified too far cannot
// be brought back. With 0.02 two windows in sixty of real meshes had too little left for it.
constexpr double kReserve = 0.04;
// Cells that are not written when they are due, for the end: where few are asked for, the last ones
// depend on the shape of what is left.
constexpr double kHeldBack = 10;
// A window that had to pass its bound to make room shows where the next one will end, too.
constexpr double kAgain = 0.8;
// With a bound on the error the first window makes this share of what it allows. Where the stream
// begins with little detail the bound rises by no more than this from window to window: what these
// leave unused serves the others. By half of it some streams of a few windows end before they have
// come near.
constexpr double kFirstError = 0.5, kLargestRise = 2.5;
// Of what is allowed: windows that made less squared error say nothing of the next one, as where a
// field has been zero, or next to it beside what comes.
constexpr double kUnspent = 0.01;
// Share of a correction that is made at once, and the largest step.
constexpr double kDamping = 0.7, kLargestChange = 4;

// A bound is approached in so many passes for reductions stronger than this, where it takes 10 % of
// the RMS error and 5 % more time, and changes little at 0.1, for which it takes effort; for all
// where a pilot tells the final bound: swept up to that in one go, each tile for itself, a window
// of nine cylinders in a cube had 1.7 times the error at 0.3 and could not be brought to its
// target.
constexpr int kApproaches = 4;
constexpr double kStrong = 12, kStrongWithEffort = 4;
// And where nobody knows what is to come, since a window may be far simpler than the one before:
// there every window is, in fewer and larger steps. With four by twos errors were within 2 %, for
// 6 to 20 % more time; but as flips come between the passes, fewer of those leave more cells flat.
constexpr int kLongApproaches = 2;
constexpr double kLongStep = 3;
// One of a wide front in a single step, at 0.9 times the time and less than 1 % more RMS error; of
// fronts of 2,000 to 33,000 cells it would be 1 to 4 % more.
constexpr int kWideApproaches = 1;
constexpr double kWideStep = 8;
// A sample by which all parts are alike knows of no window, either. Where a stream is reduced by
// less than this a single pass does: errors at 0.3 and 0.5 were 0.67 to 0.99 times those without,
// in 1.0 to 1.25 times the time. At 0.1 it changes them by 1 to 3 %.
constexpr int kEvenApproaches = 1;
constexpr double kEvenStep = 4, kEvenReduction = 5;
// Up to an error every window approaches its bound, and stops where it has made what is allowed by
// then: tiles that came first would otherwise use that up, and the others, and the windows after
// them, stay as they were.
constexpr int kApproachesToError = 4;
constexpr double kStepToError = 3;
// Such a window gives up this share of its cells at most for others: a stream is seldom as it
// began.
constexpr double kGivenUp = 0.1;
// Of its share, what such a window may keep where memory is bounded and the stream is of few
// windows: there those with an end that needs little have up to twice the error where it keeps its
// share alone. Of longer streams, detail at the beginning may leave next to nothing for the end
// where it keeps more: 1.5 million graded cells in 10 MB missed their target, with an RMS error of
// 1.6 %, for 0.004 %.
constexpr double kTightShare = 2;
// Where windows leave so many times the target, what they took out of order is made up for at the
// end, and no passes on the way are needed; but not what is lost where a window leaves less than
// one of so many cells: 1e7 cells at 0.001 by way of twice the target had 16 % RMS error without
// these passes, 3.2 with them.
constexpr double kRoomyTimes = 2, kRoomyReduction = 25;

namespace {

// Of cells, those that are whole; as many as can be counted where a stream claims more.
int64_t whole(double cells) {
  return static_cast<int64_t>(std::clamp(cells, 0.0, 0x1p60));
}

}  // namespace

double CommonBound::wanted(const Ledger& ledger) const {
  return std::max({static_cast<double>(target_.cells), target_.ratio * total(ledger), 1.0});
}

// Without a count, as much again is expected.
double CommonBound::total(const Ledger& ledger) const {
  return total_ >= 0 ? static_cast<double>(total_) : 2 * static_cast<double>(ledger.read);
}

// Of all cells out, those of the first `seen` cells in.
double CommonBound::shareOf(double seen, const Ledger& ledger) const {
  const double part = std::clamp(seen / std::max(total(ledger), 1.0), 1e-9, 1.0);
  return pilot_.known() ? std::max(pilot_.shareOf(part), 1e-9) : part;
}

double CommonBound::boundForCells(const Ledger& ledger) const {
  const double all = wanted(ledger), share = shareOf(seen_, ledger);
  const double so_far = kept_ + written_at_1_ * std::pow(bound_, -kDecay);
  // Cells out of the whole stream at the bound, as a pilot's bound says; without one, as it seems.
  const double expected =
      pilot_bound_ > 0 ? all * std::pow(bound_ / pilot_bound_, -kDecay) : so_far / share;
  if (!(expected > 0)) return bound_;  // nothing is simplified yet
  const double trust = pilot_bound_ > 0 ? kTrust : 0;
  const double more = (so_far + trust * expected) / ((share + trust) * expected);
  const double to_come = (1 - share) * expected * more;
  // With x = (new bound / bound)^-kDecay: what is kept and what is to come shrink alike,
  // (kept + to come) x = wanted - written; but only what is to come can grow.
  const double left = std::max(all - written_, 1.0) * (1 + kReserve);
  const double x = left < kept_ + to_come ? left / std::max(kept_ + to_come, 1.0)
                                          : (left - kept_) / std::max(to_come, 1.0);
  const double change = std::pow(x, -kDamping / kDecay);
  return bound_ * std::clamp(change, 1 / kLargestChange, kLargestChange);
}

// The squared error rises with the bound b as b^(4/7), being proportional to n^(-4/3). The bound of
// a window that met the limit is the one that it came to.
double CommonBound::nextBound(const Ledger& ledger) const {
  const double for_cells = boundForCells(ledger);
  if (!(target_.error > 0)) return for_cells;
  const double change = std::pow(error_room_, 7.0 / 4);
  const double risen = bound_ * std::min(change, kLargestRise);
  return target_.countsCells() ? std::min(for_cells, risen) : risen;
}

bool CommonBound::knowsBound(const Ledger& ledger) const {
  const bool is_by_error = target_.error > 0 && !target_.countsCells();
  return bound_ > 0 && !(is_by_error && ledger.error < kUnspent * ledger.error_limit);
}

// So many that the target stays in reach even if all that is to come is written as it is; where
// nobody knows what is to come, even if it is nothing.
int64_t CommonBound::leastOf(const Ledger& ledger) const {
  const int64_t to_come = total_ >= 0 ? total_ - ledger.read : 0;
  const int64_t in = ledger.read + to_come, all = target(in);
  if (all >= in) return std::numeric_limits<int64_t>::max();  // nothing is to be simplified
  const int64_t slack = std::max<int64_t>(all / 1000, 5);
  return all - slack - ledger.written - to_come;
}

// What was learnt in the units of the last window, in those of this one.
void CommonBound::changeUnits(double rescaled) {
  bound_ *= rescaled;
  pilot_bound_ *= rescaled;
  written_at_1_ *= std::pow(rescaled, kDecay);
}

// With fewer fronts targets are missed more often.
bool CommonBound::spreads(const Ledger& ledger) const {
  return target_.countsCells() && !(pilot_.bound > 0) &&
         static_cast<double>(ledger.live) >= kLeastFronts * static_cast<double>(ledger.front);
}

void CommonBound::approach(const Ledger& ledger, Goal& goal) const {
  if (target_.error > 0) {
    goal.approaches = kApproachesToError;
    goal.step = kStepToError;
    return;
  }
  const bool is_roomy = parked_ >= kRoomyTimes && effort_ == Effort::kNormal &&
                        total(ledger) <= kRoomyReduction * wanted(ledger);
  if (is_tight_ || is_roomy) return;
  const double strong = effort_ == Effort::kHigh ? kStrongWithEffort : kStrong;
  const bool is_strong = parked_ * total(ledger) > strong * wanted(ledger);
  const bool is_blind = !pilot_.known() && spreads(ledger);
  const bool is_final = pilot_.bound > 0;
  const bool is_even = pilot_.isEven() && total(ledger) < kEvenReduction * wanted(ledger);
  if (is_even && !is_strong) {
    goal.approaches = kEvenApproaches;
    goal.step = kEvenStep;
    return;
  }
  if (!is_blind && !is_final && !is_strong) return;
  const bool is_long = parked_ > 1 || (!pilot_.known() && !ledger.flips);
  goal.approaches = kApproaches;
  if (!is_long) return;
  const bool is_wide = ledger.front >= kWideFront;
  goal.approaches = is_wide ? kWideApproaches : kLongApproaches;
  goal.step = is_wide ? kWideStep : kLongStep;
}

// About the same ratio all along the stream, or what a sample says of it. `due`: cells out that the
// cells seen should leave.
void CommonBound::spread(double due, const Ledger& ledger, Goal& goal) const {
  const auto left = [&](double share) {
    const double may_stay = share * due - kHeldBack - static_cast<double>(ledger.written);
    return ledger.front + whole(may_stay);
  };
  const bool is_short = total_ >= 0 && total_ < kFewWindows * ledger.window;
  goal.cells = std::min(goal.cells, left(is_tight_ && is_short ? kTightShare : 1));
  goal.enough_cells = left(1 - kGivenUp);
}

Goal CommonBound::goalOf(const Ledger& ledger) {
  changeUnits(ledger.rescaled);
  const double seen = static_cast<double>(ledger.read - ledger.front);
  // Cells that are written are lost for the target: not many more than are due by now.
  const double due = wanted(ledger) * shareOf(seen, ledger);
  const double may_go = due - kHeldBack - static_cast<double>(ledger.written);
  // In a window of less than two fronts the front alone is more than what may stay.
  const int64_t may_stay = std::max(ledger.keep, ledger.front);
  Goal goal{may_stay + whole(may_go), leastOf(ledger), false, ledger.front};
  // An error bound is not passed to make room: what comes first would use it up.
  if (target_.error > 0) goal.most_error = 0;
  if (spreads(ledger)) spread(due, ledger, goal);
  if (knowsBound(ledger)) {
    goal.first_bound = nextBound(ledger);
    if (forced_) goal.first_bound = std::max(goal.first_bound, kAgain * bound_);
  } else if (pilot_.bound > 0) {
    goal.first_bound = pilot_bound_ = pilot_.bound / ledger.error_unit;
  } else {
    const double ratio = std::max(wanted(ledger) / std::max(total(ledger), 1.0), kFirstRatio);
    const double kept =
        target_.countsCells() ? ratio * static_cast<double>(ledger.live - ledger.front) : 0;
    goal.cells = std::min(goal.cells, ledger.front + whole(kept));
    if (target_.error > 0) goal.most_error = kFirstError * ledger.error_limit;
  }
  first_bound_ = goal.first_bound;
  if (first_bound_ > 0) approach(ledger, goal);
  return goal;
}

Goal CommonBound::lastGoal(const Ledger& ledger) {
  changeUnits(ledger.rescaled);
  Goal goal = lastGoalOf(last_, ledger);
  goal.first_bound = bound_;
  if (bound_ > 0 && !(parked_ > 1)) approach(ledger, goal);
  return goal;
}

void CommonBound::learn(double bound, const Ledger& before, const Ledger& after, int64_t written) {
  bound_ = bound;
  forced_ = first_bound_ > 0 && bound > first_bound_;
  written_ = static_cast<double>(after.written + written);
  kept_ = static_cast<double>(after.live - after.front - written);
  error_room_ = after.error > 0 ? after.error_limit / after.error : 1;
  seen_ = static_cast<double>(before.read - before.front);
  written_at_1_ += static_cast<double>(written) * std::pow(bound, kDecay);
}

std::unique_ptr<Budget> makeBudget(const Schema& schema, const SimplifyOptions& options,
                                   const Pilot& pilot, double parked) {
  const Target target = targetOf(schema, options);
  if (followsPaper(options.mode) || options.uniform_ratio)
    return std::make_unique<UniformRatio>(target, schema.cell_count);
  return std::make_unique<CommonBound>(target, schema.cell_count, pilot, options.memory_bytes > 0,
                                       options.effort, parked);
}

}  // namespace tetstream
