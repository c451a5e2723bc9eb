// api: where the vertices went: the vertex map and the collapse log of the public header.
#include "handles.h"
#include "trace_callbacks.h"
#include "trace_files.h"

using namespace tetstream;

tetstream_status tetstream_simplifier_set_map(tetstream_simplifier* simplifier,
                                              const tetstream_map_callbacks* callbacks) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    std::unique_ptr<MapSink> map;
    if (callbacks) map = std::make_unique<CallbackMap>(readStruct(callbacks, "callbacks"));
    s.map = std::move(map);
  });
}

tetstream_status tetstream_simplifier_set_map_file(tetstream_simplifier* simplifier,
                                                   const char* path, const char* format) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    needPlace(path, "path");
    s.map = createMapFile(path, format ? format : "");
  });
}

tetstream_status tetstream_simplifier_set_map_fd(tetstream_simplifier* simplifier, int32_t fd,
                                                 const char* format) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    needPlace(format, "format");
    s.map = createMapDescriptor(fd, format);
  });
}

tetstream_status tetstream_simplifier_set_log(tetstream_simplifier* simplifier,
                                              const tetstream_log_callbacks* callbacks) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    std::unique_ptr<LogSink> log;
    if (callbacks) log = std::make_unique<CallbackLog>(readStruct(callbacks, "callbacks"));
    s.log = std::move(log);
  });
}

tetstream_status tetstream_simplifier_set_log_file(tetstream_simplifier* simplifier,
                                                   const char* path, const char* format) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    needPlace(path, "path");
    s.log = createLogFile(path, format ? format : "");
  });
}

tetstream_status tetstream_simplifier_set_log_fd(tetstream_simplifier* simplifier, int32_t fd,
                                                 const char* format) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    needPlace(format, "format");
    s.log = createLogDescriptor(fd, format);
  });
}
