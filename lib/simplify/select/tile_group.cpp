#include "tile_group.h"

#include <algorithm>
#include <limits>

namespace tetstream {

constexpr size_t kTilesTogether = 64;  // then what they did is added, for progress to be told
// Times what it would take if all took alike: then half of the tiles are a group, half of the rest
// the next one, and few stop before they come to the bound. What is less than the little is taken
// by one tile, or two, which is cheaper than to load many.
constexpr double kTimesAlike = 2, kLittle = 0.1;

static double shareIfAlike(const std::vector<TilePiece>& tiles, size_t first, int64_t live,
                           const Goal& goal) {
  constexpr double kNoShare = std::numeric_limits<double>::infinity();
  if (!goal.last) return kNoShare;
  size_t cells = 0;
  for (size_t tile = first; tile < tiles.size(); ++tile) cells += tiles[tile].cell_count;
  const double share =
      kTimesAlike * static_cast<double>(goal.left(live)) / static_cast<double>(cells);
  return share > kLittle ? share : kNoShare;
}

TileGroup groupFrom(const std::vector<TilePiece>& tiles, size_t first, int64_t live,
                    const Goal& goal, double least_share) {
  const double least = least_share > 0 ? least_share : shareIfAlike(tiles, first, live, goal);
  const size_t most = std::min(tiles.size(), first + kTilesTogether);
  auto cells = static_cast<int64_t>(tiles[first].cell_count);
  TileGroup group = {first + 1};
  for (; group.end < most; ++group.end) {
    cells += static_cast<int64_t>(tiles[group.end].cell_count);
    if (!goal.isMet(live - cells)) continue;
    const double share = static_cast<double>(goal.left(live)) / static_cast<double>(cells);
    if (share < least) break;
    group.share = std::min(share, 1.0);
  }
  return group;
}

}  // namespace tetstream
