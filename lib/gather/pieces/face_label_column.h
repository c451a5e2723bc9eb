// gather/pieces: which cell array of a .vtu file says the labels of faces. Depends on schema.h.
#pragma once

#include <algorithm>
#include <vector>

#include "schema.h"

namespace tetstream {

// What our files call it; only triangles have labels there.
constexpr char kFaceLabelName[] = "face_label";

// A column of integers, one to a cell: that of this name, or else the first one, by which the
// programs that write triangles beside tetrahedra label both, that tells no process and no ids.
// read(column, out) reads the triangles' first rows, some that tell, into a vector of int64. -1:
// there is none.
template <class Read>
int faceLabelColumn(const std::vector<Column>& cell_data, Read read) {
  const auto labels = [](const Column& c) { return !isFloat(c.type) && c.components == 1; };
  const int named = findColumn(cell_data, kFaceLabelName);
  if (named >= 0 && labels(cell_data[static_cast<size_t>(named)])) return named;
  std::vector<int64_t> rows;
  for (size_t i = 0; i < cell_data.size(); ++i) {
    if (!labels(cell_data[i]) || namesPartition(cell_data[i].name)) continue;
    read(i, rows);
    std::sort(rows.begin(), rows.end());
    const auto end = std::unique(rows.begin(), rows.end());
    if (!areIds(static_cast<size_t>(end - rows.begin()), rows.size())) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace tetstream
