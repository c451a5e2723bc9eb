// run: what overlaps with a run: its stream read ahead. Depends on ordering.h.
#pragma once

#include <memory>

#include "ordering.h"
#include "read_ahead.h"

namespace tetstream {

// Whether batches are on their way beside the run. A memory budget is for one, as it is for a
// single patch.
bool overlaps(const RunOptions& options, const Tasks& tasks);

// The stream, or another reading of it, read ahead where that may be, and takes longer than another
// thread to begin; else null.
std::unique_ptr<ReadAhead> readAhead(Source& stream, const Ordering& ordering,
                                     const RunOptions& options, const Tasks& tasks);

}  // namespace tetstream
