// file: what a function of zstd returns. Depends on status.h, zstd.
#pragma once

#ifdef TETSTREAM_WITH_ZSTD
#include <zstd.h>
#include <zstd_errors.h>

#include <cstddef>

#include "status.h"

namespace tetstream {

// Whether it is an error, of the data or of the call; throws kNoMemory for one of neither.
inline bool zstdFailed(size_t result) {
  if (!ZSTD_isError(result)) return false;
  if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation)
    fail(Status::kNoMemory, "no memory for zstd");
  return true;
}

}  // namespace tetstream
#endif
