// format/vtk: bytes of an array that several threads decompress. Depends on vtu_run.h.
#pragma once

#include <functional>
#include <memory>

#include "values.h"
#include "vtu_file.h"

namespace tetstream {

// Opens the same values once more.
using OpenBytes = std::function<std::unique_ptr<ValueBytes>()>;

// `bytes`, which are `size` in blocks of `block_bytes`, decompressed ahead with the helpers where
// they are read in sequence on the helpers' thread: some parts side by side, of whole blocks each.
// Errors come when it is their turn. Blocks that are too large to be held come as they did.
std::unique_ptr<ValueBytes> openSideBySide(const Helpers& helpers, uint64_t size,
                                           uint64_t block_bytes, std::unique_ptr<ValueBytes> bytes,
                                           OpenBytes open);

// The same bytes, for several threads at once.
std::unique_ptr<ByteSource> openShared(std::unique_ptr<ByteSource> bytes);

}  // namespace tetstream
