#include "traced_points.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

template <class S>
uint32_t TracedPoints<S>::freePoint() {
  if (free_ != kNone) {
    const uint32_t point = free_;
    free_ = points_[point].next;
    return point;
  }
  const size_t size = points_.size();
  if (end_ == size) {
    if (size >= kNone / 2) fail(Status::kNoMemory, "more than %zu vertices are traced", size);
    growArray(size, size / 8 + 1024, [this](size_t more) { points_.resize(more); });
  }
  return end_++;
}

template <class S>
void TracedPoints<S>::add(int64_t id, const S x[3]) {
  const uint32_t point = freePoint();
  points_[point] = {{x[0], x[1], x[2]}, new_, id};
  new_ = point;
  ++count_;
}

static double leastWeight(const CellFrame& frame, const double x[3]) {
  double w[4];
  frame.weights(x, w);
  return std::min(std::min(w[1], w[2]), std::min(w[3], w[0]));
}

template <class S>
void TracedPoints<S>::buildFrames(const PlacedCell* after, size_t count) {
  frames_.resize(count);
  for (size_t n = 0; n < count; ++n) frames_[n].set(after[n].corner[0]);
}

// note: a cell so thin that its frame has no numbers is never chosen, but as the first of many.
template <class S>
size_t TracedPoints<S>::locate(const S at[3], size_t guess) const {
  const double x[3] = {static_cast<double>(at[0]), static_cast<double>(at[1]),
                       static_cast<double>(at[2])};
  if (guess < frames_.size() && leastWeight(frames_[guess], x) >= 0) return guess;
  size_t best = 0;
  double least = -1e301;
  for (size_t n = 0; n < frames_.size() && least < 0; ++n) {
    const double weight = leastWeight(frames_[n], x);
    if (weight > least) best = n, least = weight;
  }
  return best;
}

template <class S>
void TracedPoints<S>::place(uint32_t* first, uint32_t list, size_t guess, const PlacedCell* after) {
  while (list != kNone) {
    Point& point = points_[list];
    guess = locate(point.x, guess);
    const uint32_t next = point.next, cell = after[guess].cell;
    point.next = first[cell];
    first[cell] = list;
    list = next;
  }
}

template <class S>
void TracedPoints<S>::reshaped(uint32_t* first, const uint32_t* before, size_t before_count,
                               const PlacedCell* after, size_t after_count) {
  lists_.resize(before_count);
  bool any = new_ != kNone;
  for (size_t i = 0; i < before_count; ++i) {
    lists_[i] = first[before[i]];
    any = any || lists_[i] != kNone;
  }
  if (!any) return;
  buildFrames(after, after_count);
  for (size_t i = 0; i < before_count; ++i) first[before[i]] = kNone;
  for (size_t i = 0; i < before_count; ++i) place(first, lists_[i], i, after);
  place(first, new_, after_count, after);
  new_ = kNone;
}

template class TracedPoints<float>;
template class TracedPoints<double>;

}  // namespace tetstream
