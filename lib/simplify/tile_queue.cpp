#include "tile_queue.h"

#include <algorithm>

namespace tetstream {

bool TileQueue::mayStart(size_t tile) const {
  if (state_[tile - first_] != State::kWaiting) return false;
  return std::all_of(earlier_[tile].begin(), earlier_[tile].end(), [this](uint32_t other) {
    return other < first_ || state_[other - first_] == State::kDone;
  });
}

std::optional<size_t> TileQueue::take() {
  std::unique_lock lock(mutex_);
  for (;; changed_.wait(lock)) {
    while (taken_before_ < state_.size() && state_[taken_before_] != State::kWaiting)
      ++taken_before_;
    if (given_up_ || taken_before_ == state_.size()) return std::nullopt;
    const size_t end = first_ + state_.size();
    size_t best = end;
    for (size_t tile = first_ + taken_before_; tile < end; ++tile)
      if (mayStart(tile) && (best == end || ahead_[tile] > ahead_[best])) best = tile;
    if (best == end) continue;
    state_[best - first_] = State::kTaken;
    return best;
  }
}

void TileQueue::finish(size_t tile) {
  const std::lock_guard lock(mutex_);
  state_[tile - first_] = State::kDone;
  changed_.notify_all();
}

void TileQueue::giveUp() {
  const std::lock_guard lock(mutex_);
  given_up_ = true;
  changed_.notify_all();
}

}  // namespace tetstream
