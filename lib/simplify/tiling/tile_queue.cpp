#include "tile_queue.h"

#include <algorithm>

#include "wait_briefly.h"

namespace tetstream {

// That far at least.
bool TileQueue::earlierAre(State least, size_t tile) const {
  return std::all_of(earlier_[tile].begin(), earlier_[tile].end(), [this, least](uint32_t other) {
    return other < first_ || state_[other - first_] >= least;
  });
}

void TileQueue::set(size_t tile, State state) {
  const std::lock_guard lock(mutex_);
  state_[tile - first_] = state;
  changed_.notify_all();
}

// All that may be loaded: the first of those with most ahead; else the end.
size_t TileQueue::findFree() {
  while (taken_before_ < state_.size() && state_[taken_before_] != State::kWaiting) ++taken_before_;
  const size_t end = first_ + state_.size();
  size_t best = end;
  for (size_t tile = first_ + taken_before_; tile < end; ++tile) {
    const bool is_free =
        state_[tile - first_] == State::kWaiting && earlierAre(State::kStored, tile);
    if (is_free && (best == end || ahead_[tile] > ahead_[best])) best = tile;
  }
  return best;
}

std::optional<size_t> TileQueue::take() {
  std::unique_lock lock(mutex_);
  const size_t end = first_ + state_.size();
  size_t best = end;
  waitBriefly(changed_, lock, [&] {
    best = findFree();
    return best < end || given_up_ || taken_before_ == state_.size();
  });
  if (given_up_ || best == end) return std::nullopt;
  state_[best - first_] = State::kTaken;
  return best;
}

bool TileQueue::waitForEarlier(size_t tile) {
  std::unique_lock lock(mutex_);
  waitBriefly(changed_, lock, [this, tile] { return given_up_ || earlierAre(State::kDone, tile); });
  return !given_up_;
}

void TileQueue::store(size_t tile) {
  set(tile, State::kStored);
}

void TileQueue::finish(size_t tile) {
  set(tile, State::kDone);
}

void TileQueue::giveUp() {
  const std::lock_guard lock(mutex_);
  given_up_ = true;
  changed_.notify_all();
}

}  // namespace tetstream
