#include "trace_files.h"

#include "descriptor_name.h"
#include "status.h"

namespace tetstream {

// Whether the file is binary, of which the format's name and ending are `binary`.
static bool isBinary(const std::string& path, const std::string& format, const char* what,
                     const std::string& binary) {
  const auto ends = [&](const std::string& ending) {
    return path.size() > ending.size() &&
           path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
  };
  if (format == binary || (format.empty() && ends("." + binary))) return true;
  if (format == "csv" || (format.empty() && ends(".csv"))) return false;
  if (format.empty())
    fail(Status::kUnsupported, "%s: the file of %s ends in .%s or .csv", path.c_str(), what,
         binary.c_str());
  fail(Status::kUnsupported, "%s is written as \"%s\" or \"csv\", not as \"%s\"", what,
       binary.c_str(), format.c_str());
}

namespace {

// What tells a map's files from a log's.
struct MapFiles {
  using Traces = MapSink;
  static constexpr const char *kWhat = "a vertex map", *kBinary = "tetmap";
  static constexpr auto kCreateBinary = createMapBinary, kCreateText = createMapText;
};
struct LogFiles {
  using Traces = LogSink;
  static constexpr const char *kWhat = "a collapse log", *kBinary = "tetlog";
  static constexpr auto kCreateBinary = createLogBinary, kCreateText = createLogText;
};

// The format is known before anything is created.
template <class Files, class CreateBytes>
std::unique_ptr<typename Files::Traces> create(const std::string& path, const std::string& format,
                                               CreateBytes create_bytes) {
  const bool binary = isBinary(path, format, Files::kWhat, Files::kBinary);
  return binary ? Files::kCreateBinary(create_bytes()) : Files::kCreateText(create_bytes());
}

}  // namespace

std::unique_ptr<MapSink> createMapFile(const std::string& path, const std::string& format,
                                       JointFiles& joint) {
  return create<MapFiles>(path, format, [&] { return createFile(path, &joint); });
}

std::unique_ptr<LogSink> createLogFile(const std::string& path, const std::string& format,
                                       JointFiles& joint) {
  return create<LogFiles>(path, format, [&] { return createFile(path, &joint); });
}

std::unique_ptr<MapSink> createMapDescriptor(int fd, const std::string& format) {
  return create<MapFiles>("", format, [&] { return createDescriptor(fd, descriptorName(fd)); });
}

std::unique_ptr<LogSink> createLogDescriptor(int fd, const std::string& format) {
  return create<LogFiles>("", format, [&] { return createDescriptor(fd, descriptorName(fd)); });
}

}  // namespace tetstream
