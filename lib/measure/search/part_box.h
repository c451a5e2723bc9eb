// measure/search: the part of a mesh that is looked at. Depends on simplex_rows.h.
#pragma once

#include <string>

#include "simplex_rows.h"

namespace tetstream {

// The box of a text: for x, y and z a range as 0.4:0.6, with commas; an end that is left out is
// open, and the whole of space is empty text. Throws kBadArgument for others.
Box partBoxOf(const std::string& text);

// With its low sides, without its high ones, so that boxes side by side share nothing.
inline bool isWithin(const Box& box, const double place[3]) {
  bool within = true;
  for (int k = 0; k < 3; ++k) within = within && place[k] >= box.low[k] && place[k] < box.high[k];
  return within;
}

}  // namespace tetstream
