// simplify/select: how far each pass of a sweep goes. Depends on select.h.
#pragma once

#include <vector>

#include "select.h"

namespace tetstream {

// Errors are in the selector's units, as vertices remember them (settled.h).
template <class S>
class SweepBounds {
 public:
  explicit SweepBounds(Core<S>& core) : core_(core) {}

  // The bound of the first pass, from which the goal's approaches lead to the one that it gives.
  double start(const Goal& goal, double unit);
  // Where nothing is known: a bound that falls short of the goal, from the errors of the best edges
  // of some vertices. What is simplified too far at first stays so.
  double first(std::vector<float>& errors, const Goal& goal) const;
  // After one of the passes that approach it.
  double onTheWay(double bound, const Goal& goal) const;
  // After a pass up to `bound`: where the goal's cells should be reached.
  double wanted(double bound, const Goal& goal) const;
  // And how far the next pass goes towards that: no farther than what was done so far bears, where
  // errors are no longer small, since a pass takes whatever is below its bound, though others could
  // still become cheap. The same bound where it may rise no more.
  double next(double bound, double wanted) const;
  // What a pass told: the cells that it took, and the vertices that had an edge below its bound.
  void learn(int64_t taken, int64_t looking);
  // Whether a pass that took so many cells tells that higher bounds give next to nothing.
  bool areStuck(int64_t taken, const Goal& goal) const;
  // The largest error that is worth to be made for the goal, in normalised units: few edges that
  // are legal must not make up for many that are not. What is left below it is tried by all means
  // before it is widened, towards a goal that is in reach; so many edges were refused by then.
  struct Refused {
    int64_t as_large, all;
  };
  double limit() const;
  // That of all vertices, in percent of the range of the fields.
  double mostPercent() const;
  bool widen(const Goal& goal, const Refused& refused);

 private:
  // The error that an edge may have: what all vertices could have for so many percent of the range,
  // or so many times what they have in the mean (RMS).
  struct Reach {
    double percent, times;
  };
  static constexpr Reach kFree = {1, 2}, kWorth = {10, 4}, kWorthBeside = {20, 4},
                         kLastWorth = {100, 4};

  bool isNear(const Goal& goal) const;
  double heaviest() const;
  double errorIn(const Reach& reach, double weight) const;
  double partAllowed() const;
  const Reach* widest(const Goal& goal, const Refused& refused) const;
  double boundToTake(double cells) const;
  double stepToError(double limit) const;
  double distance(double share_left, const Goal& goal) const;

  Core<S>& core_;
  double unit_ = 1, yield_ = 0, error_before_ = 0;
  const Reach* reach_ = nullptr;  // none: there is no limit
};

}  // namespace tetstream
