// simplify/state: which cell is nearest to each of some points that lie in none. Depends on core.h.
#pragma once

#include <cstdint>
#include <vector>

#include "core.h"

namespace tetstream {

// In the window's units of length. It takes 48 bytes for a point, which are few as a rule.
template <class S>
class OutsidePoints {
 public:
  explicit OutsidePoints(const Core<S>& core) : core_(core) {}

  struct Found {
    uint32_t point, cell;
    double weights[4];  // of the cell's corners, for the place that is nearest
  };

  void add(uint32_t point, const double place[3]);
  // found(Found): each of those that were added, but for some that all cells are far from, by many
  // times their size; in any order, the same of the same points and cells.
  template <class Visit>
  void forNearest(Visit found) {
    search();
    for (const Point& point : points_)
      if (point.cell != kNone) found(foundAt(point));
  }

 private:
  static constexpr uint32_t kNone = 0xffffffff;
  struct Point {
    double place[3];
    double square;  // of the distance to the cell
    uint32_t point, cell;
  };

  void search();
  double meanExtent() const;
  void sortAlongLongest(double looked_at);
  void lookFrom(uint32_t cell, double beyond);
  Found foundAt(const Point& point) const;

  const Core<S>& core_;
  std::vector<Point> points_;
  size_t axis_ = 0;  // along which they are in order
  size_t left_ = 0;  // the first so many may have a nearer cell
};

}  // namespace tetstream
