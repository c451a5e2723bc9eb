#include "traced_points.h"

#include <algorithm>

#include "status.h"

namespace tetstream {

// By a half, or by what a memory budget still allows.
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
    try {
      points_.resize(size + size / 2 + 1024);
    } catch (const Error&) {
      points_.resize(size + size / 16 + 64);
    }
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

static void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

template <class S>
double TracedPoints<S>::Frame::leastWeight(const double x[3]) const {
  const double d[3] = {x[0] - o[0], x[1] - o[1], x[2] - o[2]};
  double w[3];
  for (int k = 0; k < 3; ++k) w[k] = row[k][0] * d[0] + row[k][1] * d[1] + row[k][2] * d[2];
  return std::min(std::min(w[0], w[1]), std::min(w[2], 1 - w[0] - w[1] - w[2]));
}

// The rows of the inverse of (a b c) are b x c, c x a and a x b over det (a b c).
template <class S>
void TracedPoints<S>::buildFrames(const PlacedCell* after, size_t count) {
  frames_.resize(count);
  for (size_t n = 0; n < count; ++n) {
    Frame& frame = frames_[n];
    double e[3][3];
    std::copy_n(after[n].corner[0], 3, frame.o);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) e[k][i] = after[n].corner[k + 1][i] - frame.o[i];
    for (int k = 0; k < 3; ++k) cross(e[(k + 1) % 3], e[(k + 2) % 3], frame.row[k]);
    const double det =
        e[0][0] * frame.row[0][0] + e[0][1] * frame.row[0][1] + e[0][2] * frame.row[0][2];
    for (auto& row : frame.row)
      for (double& number : row) number /= det;
  }
}

// note: a cell so thin that its frame has no numbers is never chosen, but as the first of many.
template <class S>
size_t TracedPoints<S>::locate(const S at[3], size_t guess) const {
  const double x[3] = {static_cast<double>(at[0]), static_cast<double>(at[1]),
                       static_cast<double>(at[2])};
  if (guess < frames_.size() && frames_[guess].leastWeight(x) >= 0) return guess;
  size_t best = 0;
  double least = -1e301;
  for (size_t n = 0; n < frames_.size() && least < 0; ++n) {
    const double weight = frames_[n].leastWeight(x);
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
