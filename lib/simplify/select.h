// simplify: which edges are collapsed, in which order. Depends on collapse.h.
#pragma once

#include <functional>
#include <memory>

#include "collapse.h"

namespace tetstream {

// What a window is to be brought to.
struct Goal {
  int64_t cells;        // live cells at most
  int64_t least_cells;  // and at least
  bool last;            // no later window can make up for what is missed
};

template <class S>
class Selector {
 public:
  virtual ~Selector() = default;
  // Collapses edges of the window until the goal is reached or nothing legal is left. Calls `tick`
  // every few thousand edges; it may throw to stop.
  virtual void decimate(const Goal& goal, const std::function<void()>& tick) = 0;
};

// The paper's multiple choice: the best of a few random edges (section 4). Drawn tile by tile; a
// rising bound common to all tiles keeps them at the same error.
template <class S>
std::unique_ptr<Selector<S>> makeRandomSelector(Core<S>& core, Collapser<S>& collapser,
                                                Account& account);

// Every edge in order of its error, with the ends and the midpoint as further positions: slow, and
// finds whatever legal collapse there is.
template <class S>
std::unique_ptr<Selector<S>> makeExhaustiveSelector(Core<S>& core, Collapser<S>& collapser);

}  // namespace tetstream
