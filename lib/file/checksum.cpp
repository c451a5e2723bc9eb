#include "checksum.h"

#ifdef TETSTREAM_WITH_DEFLATE
#include <libdeflate.h>
#else
#include <zlib.h>
#endif

namespace tetstream {

uint32_t checksum(uint32_t before, const void* data, size_t size) {
  if (size == 0) return before;  // a null pointer asks either library for the initial value
#ifdef TETSTREAM_WITH_DEFLATE
  return libdeflate_crc32(before, data, size);
#else
  return static_cast<uint32_t>(crc32_z(before, static_cast<const unsigned char*>(data), size));
#endif
}

}  // namespace tetstream
