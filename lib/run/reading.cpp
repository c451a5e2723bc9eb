#include "reading.h"

#include "tasks.h"

namespace tetstream {

// A stream of so many cells, which most files hold in one piece, is not read ahead.
constexpr int64_t kReadAtOnce = 1 << 14;

bool overlaps(const RunOptions& options, const Tasks& tasks) {
  return tasks.threads() > 1 && options.simplify.memory_bytes == 0;
}

std::unique_ptr<ReadAhead> readAhead(Source& stream, const Ordering& ordering,
                                     const RunOptions& options, const Tasks& tasks) {
  const int64_t cells = stream.schema().cell_count;
  const bool is_short = cells >= 0 && cells <= kReadAtOnce;
  if (!overlaps(options, tasks) || is_short || ordering.staysWithCaller()) return nullptr;
  if (!ordering.waiting()) return std::make_unique<ReadAhead>(stream, tasks);
  // To threads that the caller brings none of ours are added; and two leave no core to who is at
  // the other end as it is.
  if (options.workers || tasks.threads() == 2) return nullptr;
  return std::make_unique<ReadAhead>(stream, ordering.waiting());
}

}  // namespace tetstream
