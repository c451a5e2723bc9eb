// gather/join: values of cells as fields at the points, for solvers that have them at cells alone.
// Depends on source.h.
#pragma once

#include <memory>
#include <string>

#include "source.h"

namespace tetstream {

// The mesh with a field more for each cell array of floats that no field is called as: at a point
// the mean over the cells round it. The arrays stay. Memory is bounded; temporary files take the
// rest.
std::unique_ptr<IndexedSource> cellsToPoints(std::unique_ptr<IndexedSource> mesh,
                                             const std::string& temp_dir);

}  // namespace tetstream
