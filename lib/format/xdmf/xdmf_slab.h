// format/xdmf: hyperslabs: every so many values along each direction of an array. Depends on
// values.h.
#pragma once

#include <memory>
#include <vector>

#include "values.h"

namespace tetstream {

// Along one direction of an array of `size`: begin, begin + stride, ..., `count` of them.
struct SlabRange {
  uint64_t begin = 0, stride = 1, count = 0, size = 0;
};

bool fitsSlab(const SlabRange& range);
// The values of `values` that are in all ranges, the last of which runs fastest; at least one.
std::unique_ptr<Values> openSlab(std::unique_ptr<Values> values, std::vector<SlabRange> ranges);

}  // namespace tetstream
