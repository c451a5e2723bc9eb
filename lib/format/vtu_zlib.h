// format: the zlib blocks of one array of a .vtu file. Depends on vtu_run.h.
//
// Layout: words n, block size, size of the last block if it is shorter (else 0), n compressed
// sizes; then the n blocks, each a zlib stream of its own. In base64, words and blocks are two
// texts.
#pragma once

#include "vtu_run.h"

namespace tetstream {

std::unique_ptr<ValueBytes> openZlibBlocks(const EncodedRun& run, const VtuFile& file, uint64_t size);

// The length words of an array: 4 or 8 bytes, in the file's byte order.
uint64_t readVtuWord(EncodedRun& run, uint64_t offset, const VtuFile& file);
void readVtuWords(EncodedRun& run, uint64_t offset, const VtuFile& file, uint64_t* out,
                  size_t count);

}  // namespace tetstream
