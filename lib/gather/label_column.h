// gather: which cell array labels the cells, for formats that have one label to a cell. Depends on
// mesh_spool.h.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "mesh_spool.h"

namespace tetstream {

// An array of integers, one to a cell: that of the name, which is how the format's arrays are
// called elsewhere; else the first one with names for its labels; else the first one of which the
// cells of no process and no ids are told. `may(column)`: whether the format can hold it.
std::optional<size_t> labelColumn(MeshSpool& mesh, const char* name,
                                  const std::function<bool(size_t)>& may);

}  // namespace tetstream
