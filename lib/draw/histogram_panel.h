// draw: the share of a mesh's volume by the size of a field's error. Depends on canvas.h,
// comparison.h.
#pragma once

#include "canvas.h"
#include "comparison.h"

namespace tetstream {

// Bars on a logarithmic axis of percents of `range`, with marks at the RMS and the largest error;
// only the title where there is nothing to share out.
void drawHistogram(Canvas& canvas, const Frame& frame, const FieldComparison& field, double range);

}  // namespace tetstream
