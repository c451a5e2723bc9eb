// format/vtk: compressed blocks of a .vtu file that are decompressed whole. Depends on
// vtu_blocks.h.
#pragma once

#include <functional>

#include "vtu_blocks.h"

namespace tetstream {

class WholeDecoder {
 public:
  virtual ~WholeDecoder() = default;
  // No good block of so many bytes is longer, compressed.
  virtual size_t mostFor(size_t size) const = 0;
  // False: it is not a block of `size` bytes, or this cannot tell.
  virtual bool decode(const unsigned char* packed, size_t packed_size, unsigned char* out,
                      size_t size) = 0;
};

// Holds one block, in memory for it and for its compressed bytes. What the decoder does not know is
// read by what `otherwise` opens, once there is such a block; if that is null it is damaged.
std::unique_ptr<ValueBytes> openWholeBlocks(
    BlockTable table, uint64_t size, std::unique_ptr<WholeDecoder> decoder,
    std::function<std::unique_ptr<ValueBytes>()> otherwise = nullptr);

}  // namespace tetstream
