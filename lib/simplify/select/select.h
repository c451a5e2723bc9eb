// simplify/select: which edges are collapsed, in which order. Depends on collapse.h.
#pragma once

#include <functional>
#include <limits>
#include <memory>

#include "collapse.h"

namespace tetstream {

// What a window is to be brought to.
struct Goal {
  int64_t cells;        // live cells at most
  int64_t least_cells;  // and at least
  bool last;            // no later window can make up for what is missed
  int64_t fixed = 0;    // of the live cells: those that cannot be simplified yet
  // A sweep takes all edges up to this error, in normalised units, and dearer ones only while more
  // cells are left than wanted; 0: it finds out where to start. The last goal alone is met exactly.
  // Random choice has a bound of its own.
  double first_bound = 0;
  // Passes on the way to a bound that is given, each up to so many times the bound of the one
  // before: what a window as a whole takes first is then nearly what has the least error. On the
  // way it stops where no more than so many cells are left.
  int approaches = 0;
  double step = 2;
  int64_t enough_cells = 0;
  // And only while the error of the whole is below.
  double most_error = std::numeric_limits<double>::infinity();

  // Cells that may be taken of so many live ones.
  int64_t left(int64_t live) const { return live - (last ? cells : least_cells); }
  // Whether a sweep must stop at so many live cells. No goal is undercut; where only a ring's cells
  // or so may go, nearly all edges take too many.
  bool isMet(int64_t live) const {
    constexpr int64_t kLeastRoom = 8;  // a collapse takes 5 or 6
    const int64_t room = live - least_cells;
    return last ? live <= cells || room <= 0 : room <= kLeastRoom;
  }
};

class Selector {
 public:
  virtual ~Selector() = default;
  // Collapses edges of the window until the goal is reached or nothing legal is left. Calls `tick`
  // every few thousand edges; it may throw to stop.
  virtual void decimate(const Goal& goal, const std::function<void()>& tick) = 0;
  // The error up to which all edges were tried.
  virtual double bound() const { return 0; }
};

// The paper's multiple choice: the best of a few random edges (section 4). Drawn tile by tile; a
// rising bound common to all tiles keeps them at the same error.
template <class S>
std::unique_ptr<Selector> makeRandomSelector(Core<S>& core, Collapser<Window<S>>& collapser,
                                             Account& account);

// For comparison: the cheapest of all edges of the window, again and again (Garland and Heckbert
// 1997). Edges that are not legal wait until the window has changed.
template <class S>
std::unique_ptr<Selector> makeQueueSelector(Core<S>& core, Collapser<Window<S>>& collapser,
                                            Account& account);

// The default: patches of the window are swept at rising bounds, every vertex offering its best
// edges.
template <class S>
std::unique_ptr<Selector> makeSweepSelector(Core<S>& core, Account& account);

// Every edge in order of its error, with the ends and the midpoint as further positions: slow, and
// finds whatever legal collapse there is.
template <class Mesh>
std::unique_ptr<Selector> makeExhaustiveSelector(Core<typename Mesh::Scalar>& core,
                                                 Collapser<Mesh>& collapser);

}  // namespace tetstream
