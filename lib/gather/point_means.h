// gather: the values of a field at points that were joined: the means of theirs. Depends on
// joined_points.h.
#pragma once

#include <memory>
#include <vector>

#include "joined_points.h"

namespace tetstream {

// Of those that are finite; where none is, the first one's. Memory is bounded.
class PointMeans {
 public:
  // Reads the field once for each of its components.
  PointMeans(IndexedSource& mesh, PointJoin& points, size_t column);
  void read(uint64_t first, size_t count, void* out);

 private:
  void addComponent(IndexedSource& mesh, PointJoin& points, size_t column, size_t component);

  Column column_;
  std::vector<std::unique_ptr<RowSpool>> components_;  // of float64
};

}  // namespace tetstream
