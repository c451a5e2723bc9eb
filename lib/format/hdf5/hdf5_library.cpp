#include "hdf5_library.h"

#ifdef TETSTREAM_WITH_HDF5
#include <dlfcn.h>

#include "status.h"

namespace tetstream {

[[noreturn]] static void failLoading() {
  const char* why = ::dlerror();
  fail(Status::kUnsupported, "the format needs HDF5, which could not be loaded: %s",
       why ? why : TETSTREAM_HDF5_LIBRARY);
}

static void* symbol(void* library, const char* name) {
  void* found = ::dlsym(library, name);
  if (!found) failLoading();
  return found;
}

// It stays loaded: it has work to do when the program ends.
static Hdf5Functions load() {
  void* library = ::dlopen(TETSTREAM_HDF5_LIBRARY, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!library) failLoading();
  Hdf5Functions found;
#define HDF5_FUNCTION(name) \
  found.name = reinterpret_cast<decltype(found.name)>(symbol(library, "H5" #name));
#define HDF5_NUMBER(name)
#include "hdf5_functions.def"
#undef HDF5_FUNCTION
#undef HDF5_NUMBER
  if (found.open() < 0) fail(Status::kNoMemory, "HDF5 could not be started");
#define HDF5_FUNCTION(name)
#define HDF5_NUMBER(name) found.name = *static_cast<const hid_t*>(symbol(library, "H5" #name "_g"));
#include "hdf5_functions.def"
#undef HDF5_FUNCTION
#undef HDF5_NUMBER
  return found;
}

const Hdf5Functions& hdf5() {
  static const Hdf5Functions functions = load();
  return functions;
}

// Not every build of the library may be used by several threads.
static std::recursive_mutex& turns() {
  static std::recursive_mutex mutex;
  return mutex;
}

Hdf5Turn::Hdf5Turn() : lock_(turns()) {
  hdf5().Eget_auto2(H5E_DEFAULT, &print_, &print_data_);
  hdf5().Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Turn::~Hdf5Turn() {
  hdf5().Eclear2(H5E_DEFAULT);
  hdf5().Eset_auto2(H5E_DEFAULT, print_, print_data_);
}

}  // namespace tetstream
#endif
