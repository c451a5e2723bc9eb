// mesh/topology: points that lie in cells and are told where they lie when cells give way to
// others. Depends on base.
#pragma once

#include <vector>

#include "barycentric.h"
#include "memory.h"
#include "topology.h"

namespace tetstream {

// A cell with its corners' positions, its volume positive.
struct PlacedCell {
  uint32_t cell;
  double corner[4][3];
};

// Each cell knows its first point, each point the next one of its cell. The cells' part, an array
// of first points, kNone where there are none, belongs to whoever has the cells.
template <class S>
class TracedPoints {
 public:
  struct Point {
    S x[3];
    uint32_t next;
    int64_t id;
  };

  explicit TracedPoints(Account& account) : points_(account) {}

  // A new point, in no cell: reshaped puts it into one.
  void add(int64_t id, const S x[3]);

  // The `after` cells have taken the place of the `before` ones, some of which may be the same, in
  // another shape: the points of those, and new ones, go to the cell of these that they lie in. One
  // in none of them goes to the cell whose smallest weight there is largest. Points of before[i]
  // are looked for in after[i] first. There is at least one cell after.
  void reshaped(uint32_t* first, const uint32_t* before, size_t before_count,
                const PlacedCell* after, size_t after_count);

  // Each point of the cell goes to the cell to(x), which may be the same.
  template <class To>
  void move(uint32_t* first, uint32_t cell, To to);

  // visit(id, x) for each point of a cell, which has none then.
  template <class Visit>
  void take(uint32_t& first, Visit visit);

  size_t count() const { return count_; }
  size_t capacity() const { return points_.size(); }  // points that there is memory for

 private:
  uint32_t freePoint();
  void buildFrames(const PlacedCell* after, size_t count);
  size_t locate(const S at[3], size_t guess) const;
  void place(uint32_t* first, uint32_t list, size_t guess, const PlacedCell* after);

  Array<Point> points_;
  uint32_t end_ = 0;       // all points in use are below
  uint32_t free_ = kNone;  // a list, as `new_` is
  uint32_t new_ = kNone;
  size_t count_ = 0;
  std::vector<uint32_t> lists_;    // of the cells before
  std::vector<CellFrame> frames_;  // of the cells after
};

template <class S>
template <class To>
void TracedPoints<S>::move(uint32_t* first, uint32_t cell, To to) {
  for (uint32_t* at = first + cell; *at != kNone;) {
    Point& point = points_[*at];
    const uint32_t other = to(point.x);
    if (other == cell) {
      at = &point.next;
      continue;
    }
    const uint32_t moved = *at;
    *at = point.next;
    point.next = first[other];
    first[other] = moved;
  }
}

template <class S>
template <class Visit>
void TracedPoints<S>::take(uint32_t& first, Visit visit) {
  while (first != kNone) {
    Point& point = points_[first];
    visit(point.id, point.x);
    const uint32_t next = point.next;
    point.next = free_;
    free_ = first;
    first = next;
    --count_;
  }
}

}  // namespace tetstream
