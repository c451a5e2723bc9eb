// gather/collect: which cell array labels the cells, for formats that have one label to a cell.
// Depends on mesh_spool.h.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "mesh_spool.h"

namespace tetstream {

// An array of integers, one to a cell: that of the name, which is how the format's arrays are
// called elsewhere; else the first one with names for its labels; else the first one that tells no
// processes and does not look like ids. `may(column)`: whether the format can hold it.
std::optional<size_t> labelColumn(MeshSpool& mesh, const char* name,
                                  const std::function<bool(size_t)>& may);

constexpr size_t kMostGroups = 1 << 16;  // more labels than that are numbers, no groups

// Whether an array of integers can be groups: all from `least` to `most`, not too many.
bool canBeGroups(MeshSpool& mesh, size_t column, int64_t least, int64_t most);

// Labels of cells, of one array, kRowsAtOnce at most.
void readLabels(MeshSpool& mesh, size_t column, uint64_t first, size_t count, int64_t* out);

}  // namespace tetstream
