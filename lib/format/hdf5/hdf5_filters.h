// format/hdf5: undoes the filters of HDF5's chunks. Depends on base only.
#pragma once

#include <cstddef>
#include <vector>

namespace tetstream {

enum class Hdf5Filter { kDeflate, kShuffle, kFletcher32 };

using Hdf5Chunk = std::vector<unsigned char>;

// Each replaces `chunk` by what it was made of; false: it is damaged.
bool inflateChunk(Hdf5Chunk& chunk, size_t most);  // `most`: bytes that may come out
bool unshuffleChunk(Hdf5Chunk& chunk, size_t element);
bool checkFletcher32(Hdf5Chunk& chunk);  // and takes it off

}  // namespace tetstream
