// simplify: whether what leaves the window stays beside it until all has been read. Depends on
// target.h.
#pragma once

#include "pilot.h"
#include "target.h"

namespace tetstream {

// Cells that leave a window are lost for what comes: what is dear among them has been collapsed,
// what has become cheap beside others has not, and no quadric is made anew from them. Where few are
// to be left of a stream, they are parked instead: the windows are simplified to some times the
// target, and once all has been read what they left is taken back, a mesh held whole, and
// simplified to the target itself.
//
// Returns that factor, or 1: nothing is parked. `window`: cells that are held. A pilot that knows
// the bound of the target knows none for what the windows would leave.
double parkedTimes(const Schema& schema, const SimplifyOptions& options, int64_t window,
                   const Pilot& pilot);
// Cells: more mean that the windows leave more than they should, and parking has to stop.
int64_t mostParked(const SimplifyOptions& options);

}  // namespace tetstream
