// stream: batches that are written while the next ones are made. Depends on source.h, tasks.h.
#pragma once

#include <algorithm>
#include <optional>

#include "source.h"
#include "tasks.h"

namespace tetstream {

// Batches that may wait at once. Few are enough for two threads, the reduced mesh is small; with
// many a window's worth comes in less time than one of them takes to write it.
constexpr size_t batchesBehind(size_t threads) {
  return std::clamp<size_t>(2 * threads, 4, 16);
}

// Hands on to `out` what it is given, batch by batch; what `out` throws comes with a later call.
// Borrows both. `out` is called by one thread at a time, which for `put` may be another one than
// the caller's, some batches later; short streams are written by the caller's thread.
class WriteBehind final : public Sink {
 public:
  WriteBehind(Sink& out, const Tasks& tasks);
  ~WriteBehind() override;  // waits for the batch that is being written; drops the others
  void begin(const Schema& schema) override;
  void put(const BatchView& batch) override;
  void finish() override;
  // Returns when everything is written that was put, or throws what that threw.
  void settle();

 private:
  class Queue;
  Sink& out_;
  const Tasks& tasks_;
  size_t put_ = 0;                    // batches
  std::optional<Kept<Queue>> queue_;  // once it has begun
};

}  // namespace tetstream
