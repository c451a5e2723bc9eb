// run: two inputs compared. Depends on layout, measure, run.h.
#pragma once

#include "comparison.h"
#include "run.h"

namespace tetstream {

// The plan that the options make.
ComparePlan comparePlanOf(const RunOptions& options);

// Reads both to their ends, each in an order of its own, in any that is given.
std::unique_ptr<Comparison> compareInputs(Input& original, Input& simplified,
                                          const RunOptions& options,
                                          const ProgressFunction& progress);

}  // namespace tetstream
