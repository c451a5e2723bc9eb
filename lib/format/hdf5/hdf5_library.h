// format/hdf5: libhdf5, which is loaded when the first file needs it. Depends on hdf5.h of the
// system only.
//
// note: it is not linked. With what stands behind it, it would take more memory at each start of
// each program that has no such file than such a program takes in all.
#pragma once

#ifdef TETSTREAM_WITH_HDF5
#include <hdf5.h>

#include <mutex>

namespace tetstream {

struct Hdf5Functions {
#define HDF5_FUNCTION(name) decltype(&::H5##name) name;
#define HDF5_NUMBER(name) hid_t name;
#include "hdf5_functions.def"
#undef HDF5_FUNCTION
#undef HDF5_NUMBER
};

// Throws kUnsupported if the library is not there, or lacks one of them.
const Hdf5Functions& hdf5();

// While it lives, the library is this thread's alone and prints nothing.
class Hdf5Turn {
 public:
  Hdf5Turn();
  ~Hdf5Turn();
  Hdf5Turn(const Hdf5Turn&) = delete;
  Hdf5Turn& operator=(const Hdf5Turn&) = delete;

 private:
  std::unique_lock<std::recursive_mutex> lock_;
  H5E_auto2_t print_ = nullptr;
  void* print_data_ = nullptr;
};

}  // namespace tetstream
#endif
