// simplify: what a sweep remembers of a free vertex for the next one. Depends on window.h.
//
// An edge need not be looked at again while its error is above the bound and its surroundings stay
// as they are. Of every edge between free vertices that was not refused, the error is at least what
// is remembered with one of its ends; new vertices start with 0. A refused edge is forgotten until
// something changes round it. Kept where the window will have the vertex's rank in the output.
#pragma once

#include <atomic>
#include <bit>

#include "window.h"

namespace tetstream {

struct Settled {
  float least;   // error of an edge; infinity when none is left
  bool refused;  // edges that were not legal are not counted
  bool spared;   // edges of a lower error are left, which had a higher price
};

constexpr uint64_t kRefusedBit = uint64_t{1} << 32, kSparedBit = uint64_t{1} << 33;

template <class S>
Settled settledOf(Window<S>& window, uint32_t v) {
  const uint64_t bits = window.outRank(v);
  return {std::bit_cast<float>(static_cast<uint32_t>(bits)), (bits & kRefusedBit) != 0,
          (bits & kSparedBit) != 0};
}

template <class S>
void settle(Window<S>& window, uint32_t v, Settled s) {
  window.outRank(v) = std::bit_cast<uint32_t>(s.least) | (s.refused ? kRefusedBit : 0) |
                      (s.spared ? kSparedBit : 0);
}

// Its edges must be looked at again, whatever the bound.
template <class S>
void unsettle(Window<S>& window, uint32_t v) {
  window.outRank(v) = 0;
}

// The same for one that had refused edges; several patches may have it on their rims.
template <class S>
void unsettleRefused(Window<S>& window, uint32_t v) {
  const std::atomic_ref<uint64_t> bits(window.outRank(v));
  if (bits.load(std::memory_order_relaxed) & kRefusedBit) bits.store(0, std::memory_order_relaxed);
}

}  // namespace tetstream
