/* The version of tetstream: the one place it stands; CMake, pkg-config and the manual read it. */
#ifndef TETSTREAM_VERSION_H
#define TETSTREAM_VERSION_H

#define TETSTREAM_VERSION_MAJOR 0
#define TETSTREAM_VERSION_MINOR 1
#define TETSTREAM_VERSION_PATCH 0

/* The number in the shared library's name. It is separate from the version above: it changes when
 * a program linked with the old library could not run with the new one, and only then. It is 0
 * until the ABI is frozen. */
#define TETSTREAM_SONAME_VERSION 0

/* One number that can be compared: 1.2.3 is 10203. */
#define TETSTREAM_VERSION_NUMBER \
  (TETSTREAM_VERSION_MAJOR * 10000 + TETSTREAM_VERSION_MINOR * 100 + TETSTREAM_VERSION_PATCH)

#endif
