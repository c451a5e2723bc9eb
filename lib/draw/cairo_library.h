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

// The functions that are used, each by its name without "cairo_".
#define TETSTREAM_CAIRO_FUNCTIONS(USE)                                                            \
  USE(create)                                                                                     \
  USE(destroy)                                                                                    \
  USE(status)                                                                                     \
  USE(scale)                                                                                      \
  USE(save)                                                                                       \
  USE(restore) USE(translate) USE(rotate) USE(new_path) USE(move_to) USE(line_to) USE(close_path) \
      USE(rectangle) USE(fill) USE(stroke) USE(paint) USE(set_source_rgba) USE(set_line_width)    \
          USE(set_line_join) USE(set_dash) USE(set_source_surface) USE(get_source)                \
              USE(pattern_set_filter) USE(show_text) USE(select_font_face) USE(set_font_size)     \
                  USE(text_extents) USE(status_to_string) USE(image_surface_create)               \
                      USE(image_surface_create_for_data) USE(svg_surface_create_for_stream)       \
                          USE(surface_finish) USE(surface_status) USE(surface_destroy)            \
                              USE(surface_write_to_png_stream)

struct Cairo {
#define TETSTREAM_MEMBER(name) decltype(&::cairo_##name) name;
  TETSTREAM_CAIRO_FUNCTIONS(TETSTREAM_MEMBER)
#undef TETSTREAM_MEMBER
};

// Throws kUnsupported if the library is not there, or lacks one of them.
const Cairo& cairo();

}  // namespace tetstream
#endif
