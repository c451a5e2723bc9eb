// mesh: a piece of the window, copied out to be worked on in the cache. Depends on window.h.
//
// A patch owns some free vertices and holds every cell that touches them, so their stars are
// complete; the other vertices of those cells, its rim, do not move. Inside, vertices and cells are
// numbered from 0 with 16 bits, owned vertices first, and each owned vertex has the list of its
// cells: a walk round a vertex loads no links and misses no cache. Patches that share no cell may
// be worked on at the same time.
#pragma once

#include <algorithm>
#include <bit>

#include "star_kernels.h"
#include "window.h"

namespace tetstream {

template <class S>
class Patch {
 public:
  using Scalar = S;
  // As large as numbers and sense allow; larger stars than that are left alone.
  static constexpr size_t kMostCells = 65000, kMostVertices = 65000;

  Patch(Account& account, Window<S>& window);

  // `cells`: at least all live cells that touch an owned vertex; dead ones are passed over.
  // `live_cells`: of the whole window. False if the piece is too large: nothing is loaded then.
  bool load(const uint32_t* owned, size_t owned_count, const uint32_t* cells, size_t cell_count,
            int64_t live_cells);
  // Puts what was changed into the window. The patch can still be looked at, until the next load.
  void store() { window_.mesh.countOut(storeUncounted()); }
  // The same beside other patches: returns the cells that died, by which the window's count of live
  // ones is to be lowered once they have come to rest.
  int64_t storeUncounted();

  uint32_t ownedEnd() const { return owned_; }
  uint32_t largestStar() const { return largest_star_; }  // of an owned vertex, as loaded
  uint32_t vertexEnd() const { return vertices_; }
  uint32_t cellEnd() const { return cells_; }
  bool isLive(uint32_t c) const { return corner_[4 * size_t{c}] != kGoneCorner; }
  uint32_t vertexOf(uint32_t c, uint32_t j) const { return corner_[4 * size_t{c} + j]; }
  void cornersOf(uint32_t c, uint32_t corners[4]) const {
    for (uint32_t j = 0; j < 4; ++j) corners[j] = vertexOf(c, j);
  }
  StarCell starCell(uint32_t corner) const {
    const uint8_t* t = kOpposite[corner % 4];
    const uint32_t c = corner / 4;
    return {c, {vertexOf(c, t[0]), vertexOf(c, t[1]), vertexOf(c, t[2])}};
  }
  int64_t liveCells() const { return live_; }  // of the whole window

  bool isFree(uint32_t v) const { return v < owned_ && !(flags_[v] & kCollapsed); }
  bool isBoundary(uint32_t v) const { return flags_[v] & kBoundary; }
  // Owned by another patch: on a seam.
  bool isFreeElsewhere(uint32_t v) const { return v >= owned_ && isFreeVertex(flags_[v]); }

  // Values of all vertices, quadrics of the owned ones. The row behind those, of ownedEnd(), is for
  // what is not to be kept.
  S* values(uint32_t v) { return &values_[v * value_stride_]; }
  const S* values(uint32_t v) const { return &values_[v * value_stride_]; }
  S* quadric(uint32_t v) { return &quadrics_[v * quadric_stride_]; }
  const S* allValues() const { return values_.data(); }
  const uint8_t* allFlags() const { return flags_.data(); }
  const S* allQuadrics() const { return quadrics_.data(); }
  int valueStride() const { return static_cast<int>(value_stride_); }
  int64_t* picks(uint32_t v) { return window_.picks(global_vertex_[v]); }
  double* cellMeans(uint32_t c) { return window_.cellMeans(global_cell_[c]); }
  uint32_t slotOf(uint32_t v) const { return global_vertex_[v]; }  // in the window
  uint32_t cellSlotOf(uint32_t c) const { return global_cell_[c]; }
  const uint32_t* vertexSlots() const { return global_vertex_.data(); }
  const uint32_t* cellSlots() const { return global_cell_.data(); }
  // Of a corner, in the window; the last two of a negative cell are exchanged here.
  uint32_t cornerSlot(uint32_t corner) const {
    const uint32_t cell = global_cell_[corner / 4], j = corner % 4;
    const bool exchanged = j >= 2 && (window_.mesh.cellFlags(cell) & kNegative);
    return 4 * cell + (exchanged ? 5 - j : j);
  }

  // As those of Topology; for owned vertices.
  void gather(uint32_t v, uint32_t other, Star& star, Star& ring);
  void merge(uint32_t u, uint32_t v, const Stars& stars);

  // The cells of any vertex on the boundary; of one of the rim those that are in the patch. False,
  // and none, where they may be more than `most`.
  bool gatherOnBoundary(uint32_t v, size_t most, Star& star);

  // Before cells are replaced, and again when edges were merged since: finds the slots that are of
  // use for further ones.
  void listGone();
  // More cells than that can be made at once than go.
  uint32_t freeSlots() const { return gone_end_; }
  // The cells `gone` make way for others with the corners `made`, four to a cell; `slots` becomes
  // where those are: the slots of the gone first.
  void replace(const uint32_t* gone, uint32_t gone_count, const uint32_t (*made)[4],
               uint32_t made_count, uint32_t* slots);

  // For listVertices: the cells of v's star, dead ones among them, and all corners.
  const uint16_t* starOf(uint32_t v) const { return &lists_[star_of_[v].begin]; }
  uint32_t starSize(uint32_t v) const { return star_of_[v].size; }
  const uint16_t* corners() const { return corner_.data(); }

 private:
  struct List {
    uint32_t begin;
    uint32_t size;
  };
  // Behind the lists of owned vertices lies one for all others, which is of no use: without it
  // there would be branches where there is no pattern.
  List& starOrRim(uint32_t v) { return star_of_[std::min(v, owned_)]; }

  void sizeFor(size_t owned, size_t cells);
  bool takeCells(const uint32_t* cells, size_t count);
  void listStars();
  void prefetchRows(uint32_t slot) const;
  void loadVertex(uint32_t slot);
  void forget();
  uint16_t* roomFor(size_t count);
  bool storeCell(uint32_t c);
  void listRim();
  void addCell(uint32_t c, uint32_t v, Star& star) const;
  void unlist(uint32_t c);
  void list(uint32_t c);

  Account* account_;
  Window<S>& window_;
  size_t value_stride_, quadric_stride_;
  uint32_t owned_ = 0, vertices_ = 0, cells_ = 0;
  int64_t live_ = 0;
  Array<uint16_t> local_of_;  // per vertex of the window, kGoneCorner outside this patch
  Array<uint32_t> global_vertex_, global_cell_;
  Array<uint16_t> corner_;  // four to a cell, its volume positive; kGoneCorner: dead
  Array<uint8_t> flags_;
  Array<S> values_, quadrics_;
  Array<List> star_of_;  // of owned vertices
  Array<uint16_t> lists_;
  size_t lists_end_ = 0;
  uint32_t largest_star_ = 0;
  Array<uint32_t> rim_;  // vertices of the rim that are on the boundary, each with its cells
  size_t rim_end_ = 0;
  bool rim_listed_ = false;
  Array<uint16_t> gone_;  // dead cells in no list
  uint32_t gone_end_ = 0;
};

}  // namespace tetstream
