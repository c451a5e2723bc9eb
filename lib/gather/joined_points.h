// gather: a mesh of several pieces in which the points that pieces share are one each. Depends on
// source.h, row_spool.h.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "row_spool.h"
#include "source.h"

namespace tetstream {

struct JoinPlan {
  std::vector<uint64_t> first_points;  // of the pieces that have points, ascending from 0
  int global_ids = -1;                 // the field of the points' global ids; -1: none
  std::string temp_dir;
  std::function<void(const std::string&)> note;  // may be empty
};

// Which points are one: those of different pieces with the same global id, or without ids the same
// coordinates to the last bit, become the first of them, whose values stay. Where a piece has
// several such points, a slit for example, all of them stay as they are. Memory is bounded;
// temporary files take the rest.
class PointJoin {
 public:
  // Of the points and fields of `mesh`.
  PointJoin(IndexedSource& mesh, const JoinPlan& plan);

  uint64_t count() const { return old_of_.rows(); }  // of points that are left
  bool changed() const { return old_of_.rows() < new_of_.rows(); }
  int64_t firstOf(int64_t point);  // itself, or the first one that it is
  int64_t newOf(uint64_t point);
  uint64_t oldOf(uint64_t point);

 private:
  RowSpool new_of_, old_of_;
};

// The mesh whose points are `points`, now one each.
std::unique_ptr<IndexedSource> joinPoints(std::unique_ptr<IndexedSource> mesh,
                                          std::shared_ptr<PointJoin> points);

}  // namespace tetstream
