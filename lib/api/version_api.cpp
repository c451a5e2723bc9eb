// api: version and status of the public header.
#include "guard.h"

#define TETSTREAM_WORD(number) #number
#define TETSTREAM_WORDS(major, minor, patch) \
  TETSTREAM_WORD(major) "." TETSTREAM_WORD(minor) "." TETSTREAM_WORD(patch)
#ifdef TETSTREAM_WITH_ZSTD
#define TETSTREAM_BUILD " (zstd)"
#else
#define TETSTREAM_BUILD " (no zstd)"
#endif

int32_t tetstream_version_number(void) {
  return TETSTREAM_VERSION_NUMBER;
}

const char* tetstream_version_text(void) {
  return TETSTREAM_WORDS(TETSTREAM_VERSION_MAJOR, TETSTREAM_VERSION_MINOR, TETSTREAM_VERSION_PATCH)
      TETSTREAM_BUILD;
}

const char* tetstream_status_name(tetstream_status status) {
  return tetstream::statusName(static_cast<tetstream::Status>(status));
}
