// stream: batches of a source that are read while those before are worked on. Depends on source.h,
// tasks.h, waiting.h.
#pragma once

#include <memory>
#include <optional>

#include "source.h"
#include "tasks.h"
#include "waiting.h"

namespace tetstream {

// Batches that may wait at once, the one that is worked on among them: of kBatchCells 1.2 MB. Three
// made two threads 4 % slower on 3 million cells; 24 were no faster.
constexpr size_t kBatchesAhead = 8;

// Gives what `in` gives, batch by batch; what `in` throws comes when its turn has come. Borrows
// both. The source is read by one thread at a time, which may be another one than the caller's; not
// before the first batch is asked for, and not beyond some batches ahead. Short streams are read by
// the caller's thread.
class ReadAhead final : public Source {
 public:
  ReadAhead(Source& in, const Tasks& tasks);
  // By a thread of its own, since it may wait for somebody at the other end.
  ReadAhead(Source& in, std::shared_ptr<Waiting> waiting);
  // Waits for the batch that is being read, but for nobody at the other end, and ends the waiting.
  ~ReadAhead() override;
  const Schema& schema() const override { return schema_; }
  bool next(BatchView& batch) override;

 private:
  class Queue;
  std::shared_ptr<Waiting> waiting_;
  std::optional<Tasks> own_;
  const Tasks& tasks_;
  const Schema schema_;
  size_t asked_ = 0;  // batches
  Kept<Queue> queue_;
};

}  // namespace tetstream
