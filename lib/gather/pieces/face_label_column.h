// gather/pieces: which cell array of a .vtu file says the labels of faces. Depends on
// id_census.h and schema.h.
#pragma once

#include <vector>

#include "id_census.h"
#include "schema.h"

namespace tetstream {

// What our files call it; only triangles have labels there.
constexpr char kFaceLabelName[] = "face_label";

// A column of integers, one to a cell: that of this name, or else the first one, by which the
// programs that write triangles beside tetrahedra label both, that tells no process and no ids.
// Columns of tetrahedra alone are 0 for triangles: one that is so for all of them is the last
// resort. read(column, census) adds the rows of all triangles, of which there are so many, and
// returns whether there is another value than 0. -1: there is no column.
template <class Read>
int faceLabelColumn(const std::vector<Column>& cell_data, uint64_t triangles, Read read) {
  const auto labels = [](const Column& c) { return !isFloat(c.type) && c.components == 1; };
  const int named = findColumn(cell_data, kFaceLabelName);
  if (named >= 0 && labels(cell_data[static_cast<size_t>(named)])) return named;
  int zero = -1;
  for (size_t i = 0; i < cell_data.size(); ++i) {
    if (!labels(cell_data[i]) || namesPartition(cell_data[i].name)) continue;
    IdCensus census(triangles, kFewestFacesOfALabel);
    const bool labelled = read(i, census);
    if (labelled && !census.areIds()) return static_cast<int>(i);
    if (!labelled && zero < 0) zero = static_cast<int>(i);
  }
  return zero;
}

}  // namespace tetstream
