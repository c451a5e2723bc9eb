// draw: the sweep of a mesh as a page. Depends on canvas.h, sweep_views.h.
#pragma once

#include "canvas.h"
#include "layout_diagram.h"
#include "sweep_views.h"

namespace tetstream {

// Writes the page to `path`, as drawPicture does: an image for each moment. The title stands above.
void drawSweep(const std::string& path, const SweepViews& views, const DiagramFigures& figures,
               const std::string& title);

}  // namespace tetstream
