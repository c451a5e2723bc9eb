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

// Where the library keeps the number of one of its own types. To be read in a turn.
// note: read each time. After the application has called H5close() the library begins anew at its
// next use, with other numbers.
class Hdf5Number {
 public:
  Hdf5Number() = default;
  explicit Hdf5Number(const void* at) : at_(static_cast<const hid_t*>(at)) {}
  operator hid_t() const { return *at_; }

 private:
  const hid_t* at_ = nullptr;
};

struct Hdf5Functions {
#define HDF5_FUNCTION(name) decltype(&::H5##name) name;
#define HDF5_NUMBER(name) Hdf5Number name;
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
