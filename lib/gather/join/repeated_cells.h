// gather/join: cells that several pieces of a mesh have, as halos that no marks tell of. Depends on
// joined_points.h.
#pragma once

#include <memory>

#include "joined_points.h"

namespace tetstream {

// Of tetrahedra of `mesh` that have the same points once these are joined, those of later pieces
// than the first. Memory is a bit a point, and a bit a cell where there are any; temporary files
// take the rest.
class RepeatedCells {
 public:
  RepeatedCells(IndexedSource& mesh, PointJoin& points);
  ~RepeatedCells();
  uint64_t count() const { return count_; }
  bool has(uint64_t cell) const;
  // Of the cells that are left, by the place of one among them.
  uint64_t oldOf(uint64_t cell) const;

 private:
  struct Row;
  struct Marks;
  void take(const Row* rows, size_t count);
  void drop(uint64_t cell);
  void countKept();

  const uint64_t cells_;
  uint64_t count_ = 0;
  std::unique_ptr<Marks> marks_;  // once there is one
};

// The mesh, whose points are joined by now, without them.
std::unique_ptr<IndexedSource> withoutCells(std::unique_ptr<IndexedSource> mesh,
                                            std::shared_ptr<const RepeatedCells> repeated);

}  // namespace tetstream
