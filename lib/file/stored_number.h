// file: one binary number where it lies, in either byte order. Depends on nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace tetstream {

template <class Stored, bool kSwapped>
inline Stored storedNumber(const unsigned char* at) {
  using Bits = std::conditional_t<sizeof(Stored) == 4, uint32_t, uint64_t>;
  Bits bits;
  std::memcpy(&bits, at, sizeof bits);
  if constexpr (kSwapped && sizeof bits == 4) bits = __builtin_bswap32(bits);
  if constexpr (kSwapped && sizeof bits == 8) bits = __builtin_bswap64(bits);
  Stored value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

// An integer of four or eight bytes.
inline int64_t storedInteger(const unsigned char* at, size_t width, bool swapped) {
  if (width == 4)
    return swapped ? storedNumber<int32_t, true>(at) : storedNumber<int32_t, false>(at);
  return swapped ? storedNumber<int64_t, true>(at) : storedNumber<int64_t, false>(at);
}

}  // namespace tetstream
