// simplify: which of some tiles is worked on next, by whichever thread asks. Depends on nothing.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace tetstream {

// A tile waits for those before it that share a cell with it. So each finds what it would if they
// were worked on one after the other, however many threads there are. Never are all threads that
// ask kept waiting: the first tile that nobody has is free when nothing is being worked on.
class TileQueue {
 public:
  // Tiles [first, end); of each tile of all: those before it that it shares cells with, and how
  // much is to be done from its beginning to the end of the last that waits for it.
  TileQueue(const std::vector<std::vector<uint32_t>>& earlier, const std::vector<size_t>& ahead,
            size_t first, size_t end)
      : earlier_(earlier), ahead_(ahead), first_(first), state_(end - first, State::kWaiting) {}

  // Of the tiles that may be worked on, the first of those with most ahead; waits for one. None
  // when all were given out, or somebody gave up.
  std::optional<size_t> take();
  void finish(size_t tile);
  void giveUp();

 private:
  enum class State : uint8_t { kWaiting, kTaken, kDone };
  bool mayStart(size_t tile) const;

  const std::vector<std::vector<uint32_t>>& earlier_;
  const std::vector<size_t>& ahead_;
  const size_t first_;
  std::vector<State> state_;
  size_t taken_before_ = 0;  // no tile below that place is waiting
  bool given_up_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace tetstream
