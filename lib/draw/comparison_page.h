// draw: a comparison of two meshes as a page. Depends on canvas.h, comparison.h.
#pragma once

#include "canvas.h"
#include "comparison.h"

namespace tetstream {

// Writes the page to `path`, as drawPicture does. The title stands above it.
void drawComparison(const std::string& path, const Comparison& comparison,
                    const std::string& title);

}  // namespace tetstream
