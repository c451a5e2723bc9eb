// measure/search: the part of a mesh that is looked at. Depends on simplex_rows.h.
#pragma once

#include <string>

#include "simplex_rows.h"

namespace tetstream {

// The box of a text: for x, y and z a range as 0.4:0.6, with commas; an end that is left out is
// open, and the whole of space is empty text. Throws kBadArgument for others.
Box partBoxOf(const std::string& text);

// Of a cell: with the box's low sides, without its high ones, so that boxes side by side share
// nothing.
inline bool isWithin(const Box& box, const double place[3]) {
  bool within = true;
  for (int k = 0; k < 3; ++k) within = within && place[k] >= box.low[k] && place[k] < box.high[k];
  return within;
}

// Of a face, whose own box is told: with all sides. A body that fills the box ends at its sides,
// where few other faces lie.
inline bool isFaceWithin(const Box& box, const double centre[3], const Box& face) {
  bool within = true;
  for (int k = 0; k < 3; ++k) {
    within = within && (centre[k] >= box.low[k] || face.low[k] >= box.low[k]);
    within = within && (centre[k] < box.high[k] || face.high[k] <= box.high[k]);
  }
  return within;
}

}  // namespace tetstream
