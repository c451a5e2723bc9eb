// api: version and status of the public header.
#include "guard.h"

#define TETSTREAM_WORD(number) #number
#define TETSTREAM_WORDS(major, minor, patch) \
  TETSTREAM_WORD(major) "." TETSTREAM_WORD(minor) "." TETSTREAM_WORD(patch)
#ifdef TETSTREAM_WITH_ZSTD
#define TETSTREAM_ZSTD_WORD "zstd"
#else
#define TETSTREAM_ZSTD_WORD "no zstd"
#endif
#ifdef TETSTREAM_WITH_LZ4
#define TETSTREAM_LZ4_WORD "lz4"
#else
#define TETSTREAM_LZ4_WORD "no lz4"
#endif
#ifdef TETSTREAM_WITH_LZMA
#define TETSTREAM_LZMA_WORD "lzma"
#else
#define TETSTREAM_LZMA_WORD "no lzma"
#endif
#ifdef TETSTREAM_WITH_DEFLATE
#define TETSTREAM_DEFLATE_WORD "libdeflate"
#else
#define TETSTREAM_DEFLATE_WORD "no libdeflate"
#endif
#ifdef TETSTREAM_WITH_HDF5
#define TETSTREAM_HDF5_WORD "hdf5"
#else
#define TETSTREAM_HDF5_WORD "no hdf5"
#endif
#ifdef TETSTREAM_WITH_CAIRO
#define TETSTREAM_CAIRO_WORD "cairo"
#else
#define TETSTREAM_CAIRO_WORD "no cairo"
#endif
#ifdef TETSTREAM_V3_KERNELS
#define TETSTREAM_KERNEL_WORD "x86-64-v3 kernels"
#else
#define TETSTREAM_KERNEL_WORD "plain kernels"
#endif
#define TETSTREAM_BUILD                                                          \
  " (" TETSTREAM_ZSTD_WORD ", " TETSTREAM_LZ4_WORD ", " TETSTREAM_LZMA_WORD      \
  ", " TETSTREAM_DEFLATE_WORD ", " TETSTREAM_HDF5_WORD ", " TETSTREAM_CAIRO_WORD \
  ", " TETSTREAM_KERNEL_WORD ")"

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
