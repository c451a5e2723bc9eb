// format/tets: the places of the vertices alone. Depends on tets_input.h, tets_codec.h,
// tets_stretches.h.
#pragma once

#include <memory>

#include "bytes.h"
#include "source.h"
#include "tets_stretches.h"

namespace tetstream::tets {

// A reading for Part::kPositions, of bytes that can be sought: a chunk's columns begin with the
// positions, of which most chunks are an eighth, and no more of it is decompressed. Checksums are
// checked, and what a chunk's head claims. Of all chunks, or of a range of them.
std::unique_ptr<Source> openPlaces(std::unique_ptr<ByteSource> bytes,
                                   const ChunkRange* range = nullptr);

}  // namespace tetstream::tets
