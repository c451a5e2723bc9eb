// Blocks of memory that a target takes, and a limit on the largest: a few bytes that claim to be
// much must not be believed.
#pragma once

#include <cstddef>

namespace fuzz {

void limitAllocations(size_t bytes);   // a larger block ends the process; 0: any
void watchAllocations(bool watching);  // only then
size_t largestAllocation();            // of those watched

}  // namespace fuzz
