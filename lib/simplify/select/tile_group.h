// simplify/select: which tiles of a pass are swept at the same time. Depends on select.h, tiling.h.
#pragma once

#include "select.h"
#include "tiling.h"

namespace tetstream {

struct TileGroup {
  size_t end;        // the first tile after it
  double share = 1;  // of its cells that each tile may take
};

// The tiles from `first` on that cannot meet the goal between them, with all of their cells; or as
// many more as may take `least_share` of their cells each, or what kAlike says.
TileGroup groupFrom(const std::vector<TilePiece>& tiles, size_t first, int64_t live,
                    const Goal& goal, double least_share);

// Least shares. Of a pass where shapes come first, which takes half of the cells, or less: less to
// take is shared by fewer tiles, and in the end is taken by one after the other.
constexpr double kLeastShare = 0.6, kLeastShareOfSlices = 0.5;
// Towards the last goal: some times what each would take of what is left if all took alike. Of
// other goals there are none.
constexpr double kAlike = 0;

}  // namespace tetstream
