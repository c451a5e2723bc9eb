// stream: labels in arrays of floats, as programs write them that have no other arrays. Depends on
// schema.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema.h"

namespace tetstream {

// Of rows of a cell array of floats, from `row` on, all components as integers. Throws kBadData for
// one that is no integer, or none that a double tells from its neighbours; `first_cell` is the
// number of row 0.
void readFloatLabels(const Column& column, const void* rows, size_t row, size_t count,
                     uint64_t first_cell, int64_t* out);

}  // namespace tetstream
