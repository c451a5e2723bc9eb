// draw: the layout diagram as a page. Depends on canvas.h, layout_diagram.h.
#pragma once

#include "canvas.h"
#include "layout_diagram.h"

namespace tetstream {

// Writes the page to `path`, as drawPicture does. The title stands above it.
void drawLayout(const std::string& path, const LayoutDiagram& diagram, const std::string& title);

}  // namespace tetstream
