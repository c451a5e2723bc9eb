// simplify/tiling: the window's cells cut into spatial tiles that fit a core's L2 cache. Depends on
// core.h.
#pragma once

#include "core.h"

namespace tetstream {

// A tile is a piece of one list of cell ids. Cells that died are taken out of it when met.
struct Tile {
  size_t begin, end;
  size_t size() const { return end - begin; }
};

template <class S>
class Tiles {
 public:
  Tiles(Core<S>& core, Account& account) : core_(core), cells_(account) {}

  // The live cells with at least one edge that may collapse, cut at medians along the longest
  // side until a tile's cells and vertices take about kTileBytes.
  void build();

  std::vector<Tile>& tiles() { return tiles_; }
  uint32_t cell(size_t place) const { return cells_[place]; }
  void remove(Tile& tile, size_t place) { cells_[place] = cells_[--tile.end]; }

 private:
  size_t cellsPerTile() const;

  Core<S>& core_;
  Array<uint32_t> cells_;
  std::vector<Tile> tiles_;
};

}  // namespace tetstream
