// simplify: WRITE. Cells leave the window in the order in which they came, or the dearest first.
// Depends on core.h.
#pragma once

#include <limits>
#include <vector>

#include "core.h"
#include "source.h"

namespace tetstream {

// What may stay in the window: live cells, and points of a map that lie in them.
struct Staying {
  uint32_t cells;
  size_t points = std::numeric_limits<size_t>::max();
};

// The cells that have been in the window longest leave first (paper, section 4), or those of the
// largest error (Wu and Kobbelt 2003: what is dear will not be simplified), each after its
// vertices; cells that touch a vertex not yet final wait. A vertex that has left with a cell is
// frozen from then on, and is finalized in the output by the last cell that uses it.
template <class S>
class Release {
 public:
  Release(Core<S>& core, Sink& out, Account& account)
      : core_(core), out_(out), batch_(core.plan.schema), ranked_(account) {
    while (other_uses_.size() + 1 < core.mostParts()) other_uses_.emplace_back(account);
  }

  // Lets cells go until no more are left than may stay or no other may go, then packs the window.
  void write(const Staying& most);
  // The same, but cells stay where they are, as if they had left, until all are taken back
  // (parking.h).
  void park(uint32_t most);
  void takeBack();
  void flush();

  // Of the cells that were left when some went, those that touched a vertex not yet final.
  int64_t frontCells() const { return front_; }
  uint64_t cellsWritten() const { return cells_; }
  uint64_t cellsGone() const { return cells_ + core_.window.mesh.parkedCells(); }
  uint64_t verticesWritten() const { return vertices_; }
  double volumeWritten() const { return volume_; }  // without signs

 private:
  bool mayGo(uint32_t cell) const;
  bool mustGo(const Staying& most) const;
  void countUses();
  void parkCell(uint32_t cell);
  void outdateSeam();
  void pack();
  void writeDearest(const Staying& most);
  float errorOf(uint32_t cell) const;
  void writeCell(uint32_t cell);
  void writeVertex(uint32_t v);
  void writeFaces(uint32_t cell);
  void writeCellData(uint32_t cell, size_t row);

  Core<S>& core_;
  Sink& out_;
  Batch batch_;
  Array<RankedCell> ranked_;
  std::vector<Array<uint32_t>> other_uses_;  // of vertices, by parts of the cells but the first
  int64_t front_ = 0;
  uint64_t cells_ = 0, vertices_ = 0;
  double volume_ = 0;
};

}  // namespace tetstream
