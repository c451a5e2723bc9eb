// run: what overlaps with a run: its stream read ahead. Depends on ordering.h.
#pragma once

#include <memory>

#include "ordering.h"
#include "read_ahead.h"

namespace tetstream {

// Whether other threads read and write batches while the run works. Not with a memory budget, which
// covers one batch and one patch.
bool overlaps(const RunOptions& options, const Tasks& tasks);

// The stream, or another reading of it, read ahead where that may be, and takes longer than another
// thread to begin; else null.
std::unique_ptr<ReadAhead> readAhead(Source& stream, const Ordering& ordering,
                                     const RunOptions& options, const Tasks& tasks);

}  // namespace tetstream
