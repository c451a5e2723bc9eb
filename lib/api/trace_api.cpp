// api: where the vertices went: the vertex map and the collapse log of the public header.
#include "handles.h"
#include "trace_callbacks.h"
#include "trace_files.h"

using namespace tetstream;

// What `make` gives becomes the simplifier's map or log.
template <class Sink, class Make>
static tetstream_status setSink(const char* function, tetstream_simplifier* simplifier,
                                std::unique_ptr<Sink> tetstream_simplifier::*place, Make make) {
  return guard(function, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    s.*place = make();
  });
}

template <class Shown, class Callbacks>
static std::unique_ptr<Shown> sinkOf(const Callbacks* callbacks) {
  if (!callbacks) return nullptr;
  const Callbacks table = readStruct(callbacks, "callbacks");
  needPlace(reinterpret_cast<const void*>(table.put), "the callback put");
  return std::make_unique<Shown>(table);
}

tetstream_status tetstream_simplifier_set_map(tetstream_simplifier* simplifier,
                                              const tetstream_map_callbacks* callbacks) {
  return setSink(__func__, simplifier, &tetstream_simplifier::map,
                 [&] { return sinkOf<CallbackMap>(callbacks); });
}

tetstream_status tetstream_simplifier_set_map_file(tetstream_simplifier* simplifier,
                                                   const char* path, const char* format) {
  return setSink(__func__, simplifier, &tetstream_simplifier::map, [&] {
    needPlace(path, "path");
    return createMapFile(path, format ? format : "", simplifier->output->files());
  });
}

tetstream_status tetstream_simplifier_set_map_fd(tetstream_simplifier* simplifier, int32_t fd,
                                                 const char* format) {
  return setSink(__func__, simplifier, &tetstream_simplifier::map, [&] {
    needPlace(format, "format");
    return createMapDescriptor(fd, format);
  });
}

tetstream_status tetstream_simplifier_set_log(tetstream_simplifier* simplifier,
                                              const tetstream_log_callbacks* callbacks) {
  return setSink(__func__, simplifier, &tetstream_simplifier::log,
                 [&] { return sinkOf<CallbackLog>(callbacks); });
}

tetstream_status tetstream_simplifier_set_log_file(tetstream_simplifier* simplifier,
                                                   const char* path, const char* format) {
  return setSink(__func__, simplifier, &tetstream_simplifier::log, [&] {
    needPlace(path, "path");
    return createLogFile(path, format ? format : "", simplifier->output->files());
  });
}

tetstream_status tetstream_simplifier_set_log_fd(tetstream_simplifier* simplifier, int32_t fd,
                                                 const char* format) {
  return setSink(__func__, simplifier, &tetstream_simplifier::log, [&] {
    needPlace(format, "format");
    return createLogDescriptor(fd, format);
  });
}
