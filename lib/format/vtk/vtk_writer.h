// format/vtk: writes legacy VTK files. Depends on file_format.h.
#pragma once

#include "file_format.h"

namespace tetstream {

// The largest number that files of versions before 5 hold in their cells.
constexpr uint64_t kVtkMostInt32 = 0x7fffffff;

// As createVtk, with another bound for cells of 32 bits.
std::unique_ptr<Sink> createVtkWith(std::unique_ptr<ByteSink> bytes, const WriteOptions& options,
                                    uint64_t most_int32);

}  // namespace tetstream
