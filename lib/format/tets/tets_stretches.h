// format/tets: a file cut into parts that are read at the same time. Depends on tets_layout.h,
// bytes.h.
#pragma once

#include <limits>
#include <vector>

#include "bytes.h"
#include "tets_layout.h"

namespace tetstream::tets {

// Chunks [first, end) of a file, which may begin with some of the part before.
struct ChunkRange {
  uint64_t first = 0, end = std::numeric_limits<uint64_t>::max();
  uint64_t offset = 0;               // of the first chunk's section
  uint64_t vertices = 0, cells = 0;  // before it
  uint64_t own_vertex = 0, own_cell = 0;
};

// What the index sections tell of all chunks, in their order; empty where they are not as they
// should be, which a reader from end to end will find.
std::vector<IndexEntry> readIndex(ByteSource& bytes);

// At most so many ranges, which have about as many cells with what comes before their own: chunks
// that may hold one of `before` ranks. Empty where that would be much, or all is in few chunks.
std::vector<ChunkRange> cutChunks(const std::vector<IndexEntry>& chunks, size_t most,
                                  uint64_t before);

}  // namespace tetstream::tets
