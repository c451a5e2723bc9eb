#include "sweep_bounds.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "settled.h"

namespace tetstream {

// From pass to pass; larger steps make the tiles uneven, smaller ones take time.
constexpr double kLeastStep = 1.15, kLargestStep = 4;
// Cells that a pass takes, for each vertex that has an edge below its bound: at first, and limits
// of what is learnt from a pass for the next.
constexpr double kFirstYield = 2, kLeastYield = 1, kLargestYield = 3;
// Share of the vertices whose best edges are below the first bound; of a sample, whose cells only
// show how they spread; with a limit on the error.
constexpr double kFirstShare = 0.1, kRoughShare = 0.6, kFirstShareToError = 0.01;
constexpr double kLargestBound = std::numeric_limits<float>::max();  // every finite error is below

template <class S>
double SweepBounds<S>::start(double first_bound, int approaches) {
  yield_ = kFirstYield;
  return std::min(std::ldexp(first_bound, -approaches), kLargestBound);
}

template <class S>
void SweepBounds<S>::learn(int64_t taken, int64_t looking) {
  if (looking > 0)
    yield_ = std::clamp(static_cast<double>(taken) / static_cast<double>(looking), kLeastYield,
                        kLargestYield);
}

template <class S>
double SweepBounds<S>::first(std::vector<float>& errors) const {
  if (errors.empty()) return std::numeric_limits<float>::min();
  const double share = std::isfinite(core_.error_limit) ? kFirstShareToError
                       : core_.options.rough            ? kRoughShare
                                                        : kFirstShare;
  const auto place = static_cast<size_t>(share * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(place),
                   errors.end());
  return std::max(errors[place], std::numeric_limits<float>::min());  // never 0: it would not rise
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

template <class S>
double SweepBounds<S>::next(double bound, const Goal& goal) {
  const auto cells = static_cast<double>(core_.window.liveCells() - goal.cells);
  const double by_count = boundToTake(std::max(cells, 0.0)) / bound;
  // The squared error rises as n^(-4/3).
  const double by_error =
      core_.error > 0
          ? std::pow(std::min(goal.most_error, core_.error_limit) / core_.error, 7.0 / 4)
          : std::numeric_limits<double>::infinity();
  const double step = std::clamp(std::min(by_count, by_error), kLeastStep, kLargestStep);
  return std::min(bound * step, kLargestBound);
}

template class SweepBounds<float>;
template class SweepBounds<double>;

}  // namespace tetstream
