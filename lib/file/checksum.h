// file: CRC-32, as zlib has it. Depends on nothing.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tetstream {

// Of what comes after that which `before` is the sum of; 0 of nothing.
uint32_t checksum(uint32_t before, const void* data, size_t size);

}  // namespace tetstream
