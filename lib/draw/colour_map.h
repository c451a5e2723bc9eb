// draw: colours for numbers. Depends on canvas.h.
#pragma once

#include "canvas.h"

namespace tetstream {

// Shares from 0 to 1; what is outside gets the end's colour. Both rise evenly in lightness or fall,
// so that they can be read in grey and by those who do not see all colours.
Colour fieldColour(double share);  // dark blue, green, pale yellow
Colour errorColour(double share);  // white, orange, dark red

}  // namespace tetstream
