#include "hdf5_filters.h"

#ifdef TETSTREAM_WITH_HDF5
#include <zlib.h>

#include <algorithm>
#include <cstdint>

namespace tetstream {

bool inflateChunk(Hdf5Chunk& chunk, size_t most) {
  Hdf5Chunk out(most);
  uLongf size = most;
  if (uncompress(out.data(), &size, chunk.data(), chunk.size()) != Z_OK) return false;
  out.resize(size);
  chunk.swap(out);
  return true;
}

// First bytes of all elements, then the second ones, and so on; what is less than an element last.
// An element may be said to have four thousand million bytes.
bool unshuffleChunk(Hdf5Chunk& chunk, size_t element) {
  if (element == 0) return false;
  const size_t count = chunk.size() / element;
  if (count < 2) return true;
  Hdf5Chunk out(chunk.size());
  const unsigned char* from = chunk.data();
  for (size_t byte = 0; byte < element; ++byte)
    for (size_t i = 0; i < count; ++i) out[i * element + byte] = *from++;
  std::copy_n(from, chunk.size() - count * element, out.data() + count * element);
  chunk.swap(out);
  return true;
}

// Fletcher's sums over words of two bytes, the first one high, of which the last may lack one.
static uint32_t fletcher32(const unsigned char* bytes, size_t size) {
  constexpr size_t kBeforeOverflow = 360;  // words
  const auto fold = [](uint32_t sum) { return (sum & 0xffff) + (sum >> 16); };
  uint32_t sum = 0, sum_of_sums = 0;
  for (size_t at = 0; at < size;) {
    const size_t end = std::min(size, at + 2 * kBeforeOverflow);
    for (; at < end; at += 2) {
      sum += static_cast<uint32_t>(bytes[at]) << 8 | (at + 1 < end ? bytes[at + 1] : 0u);
      sum_of_sums += sum;
    }
    sum = fold(sum);
    sum_of_sums = fold(sum_of_sums);
  }
  return fold(sum_of_sums) << 16 | fold(sum);
}

bool checkFletcher32(Hdf5Chunk& chunk) {
  if (chunk.size() < 4) return false;
  const size_t size = chunk.size() - 4;
  const unsigned char* stored = chunk.data() + size;
  const uint32_t sum = static_cast<uint32_t>(stored[0]) | static_cast<uint32_t>(stored[1]) << 8 |
                       static_cast<uint32_t>(stored[2]) << 16 |
                       static_cast<uint32_t>(stored[3]) << 24;
  if (sum != fletcher32(chunk.data(), size)) return false;
  chunk.resize(size);
  return true;
}

}  // namespace tetstream
#endif
