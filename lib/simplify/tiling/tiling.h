// simplify/tiling: the window's free vertices cut into tiles, each with the cells that a patch of
// it needs, in an order of which many may be worked on at the same time. Depends on core.h.
#pragma once

#include "core.h"
#include "median_cut.h"
#include "tile_contacts.h"

namespace tetstream {

// A piece of the tiling's list of vertices. Tiles of one colour share no cell.
struct TilePiece {
  size_t vertex_begin, vertex_end;
  size_t cell_count;
  uint32_t number;  // as they were cut
  uint32_t colour;
  size_t vertexCount() const { return vertex_end - vertex_begin; }
};

// Of each tile the cells that were added. They lie in blocks, each of which knows the one before
// it: how many cells a tile will have is not known before.
class TileCells {
 public:
  explicit TileCells(Account& account) : cells_(account) {}
  void reset(size_t tiles);
  void add(uint32_t tile, uint32_t cell);
  size_t count(size_t tile) const { return lists_[tile].count; }
  void copy(size_t tile, uint32_t* to) const;  // in the order in which they were added

 private:
  // note: each in a cache line, which two threads do not share.
  struct alignas(64) List {
    size_t count;
    uint32_t last_block;
  };
  std::vector<List> lists_;
  Array<uint32_t> cells_;
  std::vector<uint32_t> block_before_;
};

// What a tiling is for.
enum class TileLayout : uint8_t {
  kWhole,   // every vertex that is to be in a tile is in one
  kApart,   // to be worked on at the same time: tiles that would share next to no cells share none,
            // since vertices between them are left out
  kPieces,  // the same of few vertices in smaller tiles, for passes whose seams others come back to
  kSlices,  // the same of few vertices cut across, into more tiles
};

template <class S>
class Tiling {
 public:
  Tiling(Core<S>& core, Account& account)
      : core_(core),
        vertices_(account),
        largest_(
            static_cast<size_t>(tileVertices(core.options, Core<S>::tileVertexBytes(core.plan)))) {
    while (parts_.size() < core.mostParts()) parts_.emplace_back(account);
  }

  // Cuts the free vertices whose edges may have errors up to the bound, and their neighbours, in
  // two, again and again, until a tile's cells and vertices fit the cache: across the longest side
  // of their box, or in a stream, where most lie in the layer that came last, where few lie beside
  // the cut. `round` shifts the cuts: what lies on a seam of one round is inside a tile of another.
  // Tiles come ordered by colour.
  void build(unsigned round, float bound, TileLayout layout = TileLayout::kWhole);

  // From now on, of half as many vertices: patches of those that there were take too much memory.
  void useSmallerTiles() {
    if (largest_ > kLeastTile) largest_ /= 2;
  }

  // Of the vertices in tiles, those whose edges may have errors up to the bound.
  int64_t looking() const { return looking_; }
  // Whether there are others of these, that are in no tile.
  bool leavesOut() const { return leaves_out_; }
  // Whether edges of free vertices that were not listed have errors above the bound.
  bool othersWait() const { return others_wait_; }
  const std::vector<TilePiece>& tiles() const { return tiles_; }
  // Whether they are such as may be worked on together.
  bool areSlices() const { return are_slices_; }
  // Of each tile: those before it that it shares cells with.
  const std::vector<std::vector<uint32_t>>& earlier() const { return earlier_; }
  // Of each tile: its cells, and of those that wait for it the most that one has ahead.
  const std::vector<size_t>& ahead() const { return ahead_; }
  const uint32_t* vertices(const TilePiece& t) const { return &vertices_[t.vertex_begin]; }
  // Its cells, each once, listed in `room`, which grows if need be.
  const uint32_t* listCells(const TilePiece& t, Array<uint32_t>& room) const;

 private:
  void markVertices(float bound);
  void spreadOverLocked();
  void markNear();
  size_t listVertices();
  size_t verticesRead() const;
  size_t slicesOf(size_t vertices, size_t tile) const;
  template <class Pieces>
  std::vector<size_t> cutOnce(Pieces& pieces, const CutRule& rule,
                              const std::vector<size_t>& begins) const;
  void cut(size_t count, unsigned round, TileLayout layout);
  void setTile(size_t tile, size_t begin, size_t end);
  // What was found in a part of the window's cells.
  struct Part {
    explicit Part(Account& account)
        : near(account), cells(account), shared(account), between(account) {}
    void addBetween(uint32_t cell);
    Array<uint8_t> near;  // of each vertex: whether a cell has it and one to be looked at
    int64_t looking = 0;
    bool others_wait = false;
    TileCells cells;          // of one tile, or of any if no vertices are to be left out
    TileCells shared;         // others, of the tiles that have them when all are left out
    Array<uint32_t> between;  // the same cells
    size_t between_count = 0;
    std::vector<uint32_t> torn;  // of these: those of tiles that are to be kept apart
    TileContacts contacts;
  };

  void sortCells(uint32_t first, uint32_t end, bool whole, Part& part) const;
  void sortCells(bool whole);
  void keepApart();
  bool isTorn(uint32_t cell) const;
  void part(uint32_t cell);
  void leaveOut(uint32_t cell, uint32_t tile);
  void dropLeftOut();
  void addBetween();
  size_t tilesOf(uint32_t cell, uint32_t tiles[4]) const;
  void colour();
  void sortByColour();
  void lookAhead();

  Core<S>& core_;
  static constexpr size_t kLeastTile = 64;

  Array<uint32_t> vertices_;
  size_t largest_;           // vertices of a tile
  std::vector<Part> parts_;  // the later ones are empty where few threads work
  std::vector<TilePiece> tiles_;
  int64_t looking_ = 0;
  float bound_ = 0;
  bool others_wait_ = false, leaves_out_ = false, are_slices_ = false;
  TileContacts contacts_;
  std::vector<std::vector<uint32_t>> earlier_;
  std::vector<size_t> ahead_;
};

}  // namespace tetstream
