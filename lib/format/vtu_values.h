// format: the values of one array of a .vtu file as numbers of our types. Depends on vtu_file.h.
#pragma once

#include <memory>

#include "scalar.h"
#include "vtu_file.h"

namespace tetstream {

class VtuValues {
 public:
  virtual ~VtuValues() = default;
  // Values [first, first + count) as plain numbers of `type`; throws if an integer does not fit.
  // Sequential calls are the fast ones.
  virtual void read(uint64_t first, size_t count, void* out, ScalarType type) = 0;
};

// Opens an array that must have exactly `count` values, at least one. Nothing is believed: sizes
// that the file claims are compared with its length before anything is allocated.
std::unique_ptr<VtuValues> openVtuValues(ByteSource& bytes, const VtuFile& file,
                                         const VtuArray& array, uint64_t count);

// vtu_ascii.cpp
std::unique_ptr<VtuValues> openVtuAscii(ByteSource& bytes, const VtuArray& array, uint64_t count);

}  // namespace tetstream
