// simplify/tiling: which of some tiles is worked on next, by whichever thread asks. Depends on
// base.
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
//
// A tile is given out, to be loaded, when those before it are stored; before more is done with it
// they must be finished, too.
class TileQueue {
 public:
  // Tiles [first, end); of each tile of all: those before it that it shares cells with, and how
  // much is to be done from its beginning to the end of the last that waits for it.
  TileQueue(const std::vector<std::vector<uint32_t>>& earlier, const std::vector<size_t>& ahead,
            size_t first, size_t end)
      : earlier_(earlier), ahead_(ahead), first_(first), state_(end - first, State::kWaiting) {}

  // Of the tiles that may be loaded, the first of those with most ahead; waits for one. None when
  // all were given out, or somebody gave up.
  std::optional<size_t> take();
  // Waits until those before the tile that share a cell with it are finished; false: somebody gave
  // up.
  bool waitForEarlier(size_t tile);
  // Its cells and vertices will not change any more. What is not stored is when it is finished.
  void store(size_t tile);
  void finish(size_t tile);
  void giveUp();

 private:
  enum class State : uint8_t { kWaiting, kTaken, kStored, kDone };
  bool earlierAre(State least, size_t tile) const;
  void set(size_t tile, State state);
  size_t findFree();

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
