#include "cairo_library.h"

#ifdef TETSTREAM_WITH_CAIRO
#include <dlfcn.h>

#include "status.h"

namespace tetstream {

// The name stands for the ABI; it has been this one since 2005.
static constexpr const char* kLibrary = "libcairo.so.2";

[[noreturn]] static void failLoading() {
  const char* why = ::dlerror();
  fail(Status::kUnsupported, "a picture is drawn with cairo, which could not be loaded: %s",
       why ? why : kLibrary);
}

// It stays loaded: it keeps fonts, which it would not give back.
static Cairo load() {
  void* library = ::dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (!library) failLoading();
  Cairo functions;
#define CAIRO_FUNCTION(name)                                                                     \
  functions.name = reinterpret_cast<decltype(functions.name)>(::dlsym(library, "cairo_" #name)); \
  if (!functions.name) failLoading();
#include "cairo_functions.def"
#undef CAIRO_FUNCTION
  return functions;
}

const Cairo& cairo() {
  static const Cairo functions = load();
  return functions;
}

}  // namespace tetstream
#endif
