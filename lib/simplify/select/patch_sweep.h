// simplify/select: a patch of the window, swept at rising levels, every vertex offering its best
// edges. Depends on collapse.h, select.h.
//
// Patches that share no cell may be swept at the same time, each by a PatchSweep of its own: it
// writes to what the patch owns, and of anything else reads only what no other one writes. What it
// does is the same whoever worked on other patches before: nothing of them is left in it.
#pragma once

#include "choices.h"
#include "renewal.h"
#include "select.h"
#include "solutions.h"

namespace tetstream {

template <class S>
class PatchSweep {
 public:
  // Hubs, with more cells than this, are left alone until what is collapsed round them has made
  // them smaller. Meshes made for computing have no such star; a larger number would let the edges
  // of those that do take longer than all others.
  static constexpr uint32_t kLargestStar = 1024;

  // What outlasts a patch: what it is worked on for, and what was done since that was last asked
  // for. Errors are in units of the whole, up to a power of two: rounded, they order alike in
  // whatever units the mesh is.
  struct State {
    Goal goal{};
    double unit = 1;
    Tally tally;
    int64_t died = 0;
  };

  PatchSweep(Core<S>& core, Account& account, const State& state = {});

  void begin(const Goal& goal, double unit) {
    state_.goal = goal;
    state_.unit = unit;
  }
  const State& state() const { return state_; }

  // As Patch::load; false also if there are more vertices than choices can be kept of. Hubs are not
  // owned then, but of the rim.
  bool load(const uint32_t* owned, size_t owned_count, const uint32_t* cells, size_t cell_count);
  // Collapses edges of errors up to the bound. Returns whether a higher one could do more.
  bool sweep(float bound);
  // Puts what was changed into the window; its live cells are counted when the results are added.
  void store() {
    is_stored_ = true;
    state_.died += patch_.storeUncounted();
  }
  bool isStored() const { return is_stored_; }
  // After store: what is known now is kept for the next sweep, in the window.
  void settleAll();
  // Of each vertex with an edge up to the bound, the errors of its edges.
  void evaluateAll(float bound);
  // For any bound, as where all vertices are new: a sweep that follows need not do it again.
  bool isEvaluated() const { return evaluated_; }
  float least(uint32_t v) const { return choices_.least(v); }
  // In the last sweep.
  bool hasMoved(uint32_t v) const { return solutions_.hasMoved(v); }

  Tally takeTally() { return std::exchange(state_.tally, {}); }
  int64_t takeDied() { return std::exchange(state_.died, 0); }

  Tally& tally() { return state_.tally; }
  Patch<S>& patch() { return patch_; }
  Collapser<Patch<S>>& collapser() { return collapser_; }

 private:
  bool leaveHubs(const uint32_t* cells, size_t cell_count);
  bool mustStop() const {
    return state_.goal.isMet(patch_.liveCells()) || collapser_.errorReached();
  }
  void copySeamRow(uint32_t slot, size_t row);
  float leastAcrossSeam(uint32_t v);
  void markSurroundings();
  void addEdges(uint32_t v);
  float sweepLevel(float level, float most);
  void sweepSpared(float level);
  void solveFrom(uint32_t v, float level);
  S solve(uint32_t v, uint32_t w, float level);
  void collapseFrom(uint32_t v, float level, float most);
  void pushAfter(uint32_t u, uint32_t gone);
  void startList(uint32_t v, size_t cells);
  void listNeighbours(uint32_t v);
  void listNeighboursOfMerged(uint32_t u);
  void measureNeighbours(uint32_t u);
  EdgeList<S> edges() const {
    return {errors_.data(), neighbours_.data(), count_, static_cast<S>(state_.unit)};
  }
  void measureIn(const VertexTable<S>& table, uint32_t u);

  Core<S>& core_;
  State state_;
  bool evaluated_ = false, is_stored_ = false;
  Patch<S> patch_;
  Collapser<Patch<S>> collapser_;
  Choices choices_;
  Solutions<S> solutions_;
  Renewal<S> renewal_;
  Array<S> errors_;
  std::vector<uint32_t> kept_;            // of the owned vertices, where some are hubs
  Array<uint32_t> neighbours_, seen_;     // seen_: per vertex, the mark_ of its last listing
  Array<uint8_t> looks_;                  // of an owned vertex: at all its edges
  Array<uint8_t> marks_;                  // per vertex, when it is settled
  Array<float> spared_;                   // and the least price of those that were spared
  Array<S> seam_values_, seam_quadrics_;  // rows of the window: a vertex, its neighbours
  std::vector<S> z_;
  size_t count_ = 0;  // of the neighbours listed
  uint32_t mark_ = 0;
};

}  // namespace tetstream
