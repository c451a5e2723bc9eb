// gather/join: a mesh in which points that are one in truth become one: those that pieces share, or
// all that lie at the same place. Depends on source.h, row_spool.h.
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
  bool everywhere = false;             // pieces do not matter
  bool near = true;                    // everywhere: also where float64 differ by rounding
  int global_ids = -1;                 // the field of the points' global ids; -1: none
  std::string temp_dir;
  std::function<void(const std::string&)> note;  // may be empty
};

// Which points are one: those of different pieces with the same global id, or without ids the same
// coordinates to the last bit, become the first of them, whose values stay. Where a piece has
// several such points, a slit for example, all of them stay as they are. With `everywhere`, those
// with the same coordinates, in float64 but for rounding if that is planned, whose float values
// become the mean of theirs. Memory is bounded, then but for a bit a point; temporary files take
// the rest.
class PointJoin {
 public:
  // Of the points and fields of `mesh`.
  PointJoin(IndexedSource& mesh, const JoinPlan& plan);

  uint64_t count() const { return old_of_.rows(); }  // of points that are left
  void tell() const;                                 // the plan's note, if any, how many there are
  bool changed() const { return old_of_.rows() < new_of_.rows(); }
  const JoinPlan& plan() const { return plan_; }
  int64_t firstOf(int64_t point);  // itself, or the first one that it is
  int64_t newOf(uint64_t point);
  uint64_t oldOf(uint64_t point);

 private:
  JoinPlan plan_;
  uint64_t kept_apart_ = 0;  // places
  RowSpool new_of_, old_of_;
};

// The mesh whose points are `points`, now one each; everywhere, of labelled faces that have become
// one the first stays.
std::unique_ptr<IndexedSource> joinPoints(std::unique_ptr<IndexedSource> mesh,
                                          std::shared_ptr<PointJoin> points);

}  // namespace tetstream
