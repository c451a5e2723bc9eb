// simplify/tiling: which tiles of a window meet, and which of them are to be kept apart. Depends on
// nothing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetstream {

class TileContacts {
 public:
  struct Contact {
    uint32_t tile;  // the other one
    size_t cells;   // that have vertices of both
    bool apart;     // are to be given to one of them
  };

  void reset(size_t tiles);
  void add(uint32_t a, uint32_t b, size_t cells = 1);
  void add(const TileContacts& others);

  // Gives each tile one of two sides, so that tiles of one side share few cells, and asks for those
  // that share next to none, beside the vertices that each has (`sizes`), to be kept apart. Before,
  // all are of one side, and none are apart.
  void divide(const std::vector<size_t>& sizes);

  const std::vector<Contact>& of(uint32_t tile) const { return of_[tile]; }
  int side(uint32_t tile) const { return side_[tile]; }
  bool areApart(uint32_t a, uint32_t b) const {
    return std::find(apart_[a].begin(), apart_[a].end(), b) != apart_[a].end();
  }

 private:
  Contact& between(uint32_t a, uint32_t b);
  bool takeBetterSide(uint32_t tile, uint32_t known);

  std::vector<std::vector<Contact>> of_;
  std::vector<int> side_;
  std::vector<std::vector<uint32_t>> apart_;  // of each tile, when they are divided
};

}  // namespace tetstream
