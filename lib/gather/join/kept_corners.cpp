#include "kept_corners.h"

#include <algorithm>

#include "rows_at_once.h"

namespace tetstream {

bool losesACorner(std::vector<int64_t>& points, PointJoin& joined) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  for (int64_t& point : points) point = joined.firstOf(point);
  std::sort(points.begin(), points.end());
  return std::adjacent_find(points.begin(), points.end()) != points.end();
}

std::optional<uint64_t> cellThatLosesACorner(IndexedSource& mesh, PointJoin& joined) {
  std::vector<int64_t> rows(4 * kRowsAtOnce), points;
  const auto cells = static_cast<uint64_t>(mesh.schema().cell_count);
  for (uint64_t at = 0; at < cells; at += kRowsAtOnce) {
    const auto n = static_cast<size_t>(std::min<uint64_t>(kRowsAtOnce, cells - at));
    mesh.readCells(at, n, rows.data());
    for (size_t i = 0; i < n; ++i) {
      points.assign(&rows[4 * i], &rows[4 * i] + 4);
      if (losesACorner(points, joined)) return at + i;
    }
  }
  return {};
}

std::shared_ptr<PointJoin> joinKeepingCorners(IndexedSource& mesh, JoinPlan plan,
                                              const FindLosing& find, uint64_t* losing) {
  plan.everywhere = true;
  for (const bool near : {true, false}) {
    plan.near = near;
    auto points = std::make_shared<PointJoin>(mesh, plan);
    const std::optional<uint64_t> cell = find(*points);
    if (!cell) {
      points->tell();
      return points;
    }
    *losing = *cell;
  }
  return nullptr;
}

}  // namespace tetstream
