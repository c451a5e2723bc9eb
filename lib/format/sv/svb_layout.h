// format/sv: the bytes of .svb: its header, and where elements stand. Depends on schema.h.
//
// After the header come blocks: a descriptor of 32 bits, bit j saying whether element j is a
// vertex, then 32 elements (fewer in the last block) of four 32-bit words each.
#pragma once

#include <cstdint>
#include <cstring>

#include "schema.h"

namespace tetstream {

constexpr unsigned char kSvbVersion = 4;
constexpr size_t kSvbBlock = 32;  // elements
constexpr size_t kSvbElementBytes = 16;
constexpr size_t kSvbWords = 4;       // of an element; bounds the numbers of a vertex
constexpr uint64_t kSvbCountsAt = 8;  // place of nverts in a header without comments

inline uint32_t svbWord(const unsigned char* bytes, bool swapped) {
  uint32_t word;
  std::memcpy(&word, bytes, sizeof word);
  return swapped ? __builtin_bswap32(word) : word;
}

constexpr bool kHostIsBigEndian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;

}  // namespace tetstream
