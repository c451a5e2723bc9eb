// format/sv: turns a stream's events into the elements of a streaming mesh file, in either order.
// Depends on sv_block.h, file_format.h.
#pragma once

#include <memory>

#include "dropped_marks.h"
#include "file_format.h"
#include "sv_block.h"

namespace tetstream {

// Pre-order: a vertex stands just before the first cell that uses a vertex of its rank or above;
// last uses are negative references, explicit finalizations elements of their own.
// Post-order: ranks stay the numbering, so vertex elements stand in the order of ranks, each as
// soon as it and all lower ranks are final; memory is bounded by the stream's span.
std::unique_ptr<Sink> makeSvSink(std::unique_ptr<SvEncoder> encoder, DroppedMarks dropped,
                                 const WriteOptions& options);

}  // namespace tetstream
