// gather: which cell array of a .vtu file says the labels of faces. Depends on schema.h.
#pragma once

#include "schema.h"

namespace tetstream {

// What our files call it; only triangles have labels there.
constexpr char kFaceLabelName[] = "face_label";

// A column of integers, one to a cell: that of this name, or else the first one, by which the
// programs that write triangles beside tetrahedra label both. -1: there is none.
inline int faceLabelColumn(const std::vector<Column>& cell_data) {
  const auto labels = [](const Column& c) { return !isFloat(c.type) && c.components == 1; };
  int first = -1;
  for (int i = static_cast<int>(cell_data.size()); i-- > 0;) {
    const Column& c = cell_data[static_cast<size_t>(i)];
    if (!labels(c)) continue;
    if (c.name == kFaceLabelName) return i;
    first = i;
  }
  return first;
}

}  // namespace tetstream
