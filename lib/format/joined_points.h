// format: a mesh of several pieces in which the points that pieces share are one each. Depends on
// source.h, row_spool.h.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "source.h"

namespace tetstream {

struct JoinPlan {
  std::vector<uint64_t> first_points;  // of the pieces that have points, ascending from 0
  int global_ids = -1;                 // the field of the points' global ids; -1: none
  std::string temp_dir;
  std::function<void(const std::string&)> note;  // may be empty
};

// Points of different pieces with the same global id, or without ids the same coordinates to the
// last bit, become the first of them, whose values stay. Where a piece has several such points, a
// slit for example, all of them stay as they are. Memory is bounded; temporary files take the rest.
std::unique_ptr<IndexedSource> joinPoints(std::unique_ptr<IndexedSource> mesh,
                                          const JoinPlan& plan);

}  // namespace tetstream
