// simplify: how many cells a window may keep, and up to which error it is simplified. Depends on
// select.h.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>

#include "pilot.h"
#include "select.h"
#include "target.h"

namespace tetstream {

// What the loop knows when it sets a goal.
struct Ledger {
  int64_t read = 0;       // cells read so far
  int64_t written = 0;    // cells written so far
  int64_t front = 0;      // cells of the window that touch a vertex not yet final
  int64_t live = 0;       // cells of the window
  int64_t keep = 0;       // cells that may stay in it; what is more will be written
  double rescaled = 1;    // times an error of the last window, normalised: that of this one
  double error_unit = 1;  // times an error in normalised units: the report's
  double error = 0, error_limit = 0;  // of all that was read, made and allowed
  bool flips = false;                 // after every pass cells are flipped
  int64_t window = 0;                 // cells that there is room for
};

class Budget {
 public:
  // `total`: cells of the whole stream, negative when unknown.
  Budget(const Target& target, int64_t total) : target_(target), total_(total) {}
  virtual ~Budget() = default;

  int64_t target(int64_t read) const { return target_.cellsOf(read); }
  virtual Goal goalOf(const Ledger& ledger) = 0;
  // At the end: not below the target by more than 0.2 % and 10 cells.
  virtual Goal lastGoal(const Ledger& ledger) { return lastGoalOf(target_, ledger); }
  // From now on what leaves a window is lost for the target.
  virtual void stopParking() {}
  // What came of a goal: the bound that was reached, the ledger before and after, and the cells
  // that were written then.
  virtual void learn(double bound, const Ledger& before, const Ledger& after, int64_t written) {
    (void)bound, (void)before, (void)after, (void)written;
  }

 protected:
  static Goal lastGoalOf(const Target& target, const Ledger& ledger) {
    const int64_t all = target.cellsOf(ledger.read), slack = std::max<int64_t>(all / 500, 10);
    return {all - ledger.written, all - slack - ledger.written, true};
  }

  Target target_;
  int64_t total_;
};

// The paper's: the same ratio all along the stream. Cells of the front cannot be simplified yet and
// count in full; what an earlier window missed or saved is carried over.
class UniformRatio final : public Budget {
 public:
  using Budget::Budget;
  Goal goalOf(const Ledger& ledger) override {
    const double part = total_ > 0 ? 1 / static_cast<double>(total_) : 0;
    const double ratio = std::max(target_.ratio, static_cast<double>(target_.cells) * part);
    const double done = std::min(ratio, 1.0) * static_cast<double>(ledger.read - ledger.front);
    return {static_cast<int64_t>(done) + ledger.front - ledger.written, 0, false};
  }
};

// One bound for the whole stream, as a global order would have: where the field is simple few cells
// are left, and many where it is not. The bound is steered towards the target, on the assumption
// that what is to come resembles what has been.
class CommonBound final : public Budget {
 public:
  // `is_tight`: memory is bounded. Then no bound is approached, but up to an error: patches of the
  // few vertices that have an edge below a low one have more of a rim than a budget foresees; and
  // one of few windows may keep more than its share. `parked`: windows leave so many times the
  // target (parking.h).
  CommonBound(const Target& target, int64_t total, const Pilot& pilot, bool is_tight = false,
              Effort effort = Effort::kNormal, double parked = 1)
      : Budget(target.times(parked), total),
        last_(target),
        pilot_(pilot),
        is_tight_(is_tight),
        effort_(effort),
        parked_(parked) {}

  Goal goalOf(const Ledger& ledger) override;
  Goal lastGoal(const Ledger& ledger) override;
  void stopParking() override {
    target_ = last_;
    parked_ = 1;
  }
  void learn(double bound, const Ledger& before, const Ledger& after, int64_t written) override;

 private:
  void changeUnits(double rescaled);
  double wanted(const Ledger& ledger) const;
  double total(const Ledger& ledger) const;
  double shareOf(double seen, const Ledger& ledger) const;
  double boundForCells(const Ledger& ledger) const;
  double nextBound(const Ledger& ledger) const;
  bool knowsBound(const Ledger& ledger) const;
  int64_t leastOf(const Ledger& ledger) const;
  bool spreads(const Ledger& ledger) const;
  void approach(const Ledger& ledger, Goal& goal) const;
  void spread(double due, const Ledger& ledger, Goal& goal) const;

  Target last_;
  Pilot pilot_;
  bool is_tight_;
  Effort effort_;
  double parked_;
  double pilot_bound_ = 0;  // in normalised units
  double error_room_ = 1;   // error allowed / error made, after the last window
  double bound_ = 0, first_bound_ = 0;
  bool forced_ = false;      // the last window passed the bound that it was given
  double kept_ = 0;          // simplified cells in the window, at the bound
  double seen_ = 0;          // cells read that they and the written ones stand for
  double written_ = 0;       // cells
  double written_at_1_ = 0;  // cells as they would be at a bound of 1
};

// `parked`: times the target, that windows leave.
std::unique_ptr<Budget> makeBudget(const Schema& schema, const SimplifyOptions& options,
                                   const Pilot& pilot, double parked);

}  // namespace tetstream
