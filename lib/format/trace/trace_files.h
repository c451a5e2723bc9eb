// format/trace: the files of a vertex map and of a log of collapses, in binary and as text; their
// bytes are in tetstream-formats(5). Depends on stream (traces), base.
#pragma once

#include <memory>
#include <string>

#include "bytes.h"
#include "traces.h"

namespace tetstream {

// `format` is "tetmap" or "csv", for a log "tetlog" or "csv"; empty: by the path's ending. Throw
// kUnsupported for any other. Once finished, the file takes its name with the others of `joint`.
std::unique_ptr<MapSink> createMapFile(const std::string& path, const std::string& format,
                                       JointFiles& joint);
std::unique_ptr<LogSink> createLogFile(const std::string& path, const std::string& format,
                                       JointFiles& joint);
// Does not close `fd`.
std::unique_ptr<MapSink> createMapDescriptor(int fd, const std::string& format);
std::unique_ptr<LogSink> createLogDescriptor(int fd, const std::string& format);

// The four of them, to any place.
std::unique_ptr<MapSink> createMapBinary(std::unique_ptr<ByteSink> bytes);
std::unique_ptr<MapSink> createMapText(std::unique_ptr<ByteSink> bytes);
std::unique_ptr<LogSink> createLogBinary(std::unique_ptr<ByteSink> bytes);
std::unique_ptr<LogSink> createLogText(std::unique_ptr<ByteSink> bytes);

}  // namespace tetstream
