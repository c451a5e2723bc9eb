// gather/join: whether joining points takes corners from a cell, and joins that do not. Depends on
// joined_points.h.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "joined_points.h"

namespace tetstream {

// Whether two of a cell's points become one, which it does not name twice already. Uses the list
// up.
bool losesACorner(std::vector<int64_t>& points, PointJoin& joined);

// The first tetrahedron of which two points become one; none: there is none.
std::optional<uint64_t> cellThatLosesACorner(IndexedSource& mesh, PointJoin& points);

// Those at the same place as one, near ones too unless that takes a corner from a cell; null, and
// which cell, where it does all the same. Tells how many there are. find: as above.
using FindLosing = std::function<std::optional<uint64_t>(PointJoin&)>;
std::shared_ptr<PointJoin> joinKeepingCorners(IndexedSource& mesh, JoinPlan plan,
                                              const FindLosing& find, uint64_t* losing);

}  // namespace tetstream
