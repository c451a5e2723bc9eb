// draw: the library cairo, which is loaded when the first picture is drawn. Depends on cairo.h of
// the system only.
//
// note: it is not linked. Linked, it and the twenty libraries behind it would take 2.3 MB at each
// start of each program that never draws, as much again as such a program takes in all.
#pragma once

#ifdef TETSTREAM_WITH_CAIRO
#include <cairo-svg.h>
#include <cairo.h>

namespace tetstream {

struct Cairo {
#define CAIRO_FUNCTION(name) decltype(&::cairo_##name) name;
#include "cairo_functions.def"
#undef CAIRO_FUNCTION
};

// Throws kUnsupported if the library is not there, or lacks one of them.
const Cairo& cairo();

}  // namespace tetstream
#endif
