// simplify/state: what a sweep remembers of a free vertex for the next one. Depends on window.h.
//
// An edge need not be looked at again while its error is above the bound and its surroundings stay
// as they are. Of every edge between free vertices that was not refused, the error is at least what
// is remembered with one of its ends; new vertices, and those round which cells have changed, start
// with 0. A refused edge is forgotten until then. Kept where the window will have the vertex's rank
// in the output.
#pragma once

#include <atomic>
#include <bit>

#include "window.h"

namespace tetstream {

struct Settled {
  float least;         // error of an edge; infinity when none is left
  bool refused;        // edges that were not legal are not counted
  bool spared;         // edges of a lower error are left, which had a higher price
  bool stale = false;  // cells round it have changed since its quadric was made
};

constexpr uint64_t kRefusedBit = uint64_t{1} << 32, kSparedBit = uint64_t{1} << 33,
                   kStaleBit = uint64_t{1} << 34;

template <class S>
Settled settledOf(Window<S>& window, uint32_t v) {
  const uint64_t bits = window.outRank(v);
  return {std::bit_cast<float>(static_cast<uint32_t>(bits)), (bits & kRefusedBit) != 0,
          (bits & kSparedBit) != 0, (bits & kStaleBit) != 0};
}

template <class S>
void settle(Window<S>& window, uint32_t v, Settled s) {
  window.outRank(v) = std::bit_cast<uint32_t>(s.least) | (s.refused ? kRefusedBit : 0) |
                      (s.spared ? kSparedBit : 0);
}

// For a vertex that is new to sweeps.
template <class S>
void startUnsettled(Window<S>& window, uint32_t v, bool stale) {
  window.outRank(v) = stale ? kStaleBit : 0;
}

// Its edges must be looked at again, whatever the bound.
template <class S>
void unsettle(Window<S>& window, uint32_t v) {
  window.outRank(v) &= kStaleBit;
}

// The same, and its quadric is to be made anew. Several patches may have it on their rims.
template <class S>
void outdate(Window<S>& window, uint32_t v) {
  std::atomic_ref<uint64_t>(window.outRank(v)).store(kStaleBit, std::memory_order_relaxed);
}

}  // namespace tetstream
