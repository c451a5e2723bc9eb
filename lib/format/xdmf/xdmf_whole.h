// format/xdmf: arrays of whole numbers of which the file does not say so. Depends on mesh_pieces.h.
#pragma once

#include <optional>

#include "mesh_pieces.h"

namespace tetstream {

// The type of integers that all of the `count` values are: of floats, which are read for that, the
// narrower one of int32 and int64; none if one of them is not whole, or beyond 2^53.
std::optional<ValueType> wholeType(const MeshArray& array, uint64_t count);
// The same values in that type, as wholeType has it.
MeshArray asWhole(MeshArray array, ValueType type);

}  // namespace tetstream
