// format/hdf5: libhdf5's way to bytes that are not its own files. Depends on hdf5_file.h.
#pragma once

#ifdef TETSTREAM_WITH_HDF5
#include "hdf5_file.h"

namespace tetstream {

// A file access list by which the next file is opened in the storage of `file`. In a turn.
Hdf5Id hdf5AccessOf(Hdf5File& file);

}  // namespace tetstream
#endif
