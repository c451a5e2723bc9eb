// simplify: how far each pass of a sweep goes. Depends on select.h.
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
  // After a pass up to `bound`: where the goal's cells should be reached.
  double next(double bound, const Goal& goal);
  // What a pass told: the cells that it took, and the vertices that had an edge below its bound.
  void learn(int64_t taken, int64_t looking);

 private:
  double boundToTake(double cells) const;
  double distance(double share_left, const Goal& goal) const;

  Core<S>& core_;
  double yield_ = 0;
};

}  // namespace tetstream
