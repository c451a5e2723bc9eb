// simplify/state: who is told of flips. Depends on traced_points.h.
#pragma once

#include "traced_points.h"

namespace tetstream {

// Told of every flip: the cells of the window in the slots `before`, of one region, made way for
// those `after`, which fill the same space; no vertex was moved. Slots are those until the next
// pack.
class FlipObserver {
 public:
  virtual ~FlipObserver() = default;
  virtual void flipped(const uint32_t* before, size_t before_count, const PlacedCell* after,
                       size_t after_count) = 0;
};

}  // namespace tetstream
