// format/exodus: what reader and writer of netCDF's classic layouts share.
#pragma once

#include <cstdint>

namespace tetstream {

// What a list of the header is of; 0 and no entries: there is none.
enum NetcdfTag : uint32_t { kDimensionList = 10, kVariableList = 11, kAttributeList = 12 };

// Names, attributes and variables end at a multiple of four bytes.
constexpr uint64_t filledUp(uint64_t bytes) {
  return (bytes + 3) / 4 * 4;
}

}  // namespace tetstream
