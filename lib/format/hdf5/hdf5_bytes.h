// format/hdf5: the bytes of an HDF5 dataset as they are stored, row after row. Depends on
// hdf5_file.h.
//
// note: we take them from where libhdf5 says that they are, and undo the filters ourselves. What a
// damaged file says of the size of its chunks, the library believes when it copies out of them.
#pragma once

#ifdef TETSTREAM_WITH_HDF5
#include "hdf5_file.h"

namespace tetstream {

// A dataset whose claims were checked. Borrows the file. Opened in a turn, read in turns of its
// own. Throws kUnsupported for filters other than deflate, shuffle and fletcher32, for rows of
// chunks of more than 256 MiB, and for chunks that are cut in directions behind the second.
std::unique_ptr<ValueBytes> openHdf5Bytes(Hdf5File& file, const std::string& path,
                                          const Hdf5Shape& shape);

}  // namespace tetstream
#endif
