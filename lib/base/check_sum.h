// base: a number that tells whether bytes are still what they were. Depends on mix.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "mix.h"

namespace tetstream {

// Of four words at a time, which do not wait for each other: some gigabytes a second.
inline uint64_t checkSum(const void* data, size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  uint64_t sums[4] = {size, 1, 2, 3};
  for (size_t at = 0; at < size; at += sizeof sums) {
    uint64_t words[4] = {};
    std::memcpy(words, bytes + at, size - at < sizeof words ? size - at : sizeof words);
    for (int k = 0; k < 4; ++k) {
      sums[k] = (sums[k] ^ words[k]) * 0x9e3779b97f4a7c15ull;
      sums[k] ^= sums[k] >> 32;
    }
  }
  return mix(sums[0] + 3 * sums[1] + 5 * sums[2] + 7 * sums[3]);
}

}  // namespace tetstream
