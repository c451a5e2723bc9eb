#include "files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "failure.h"
#include "process.h"
#include "text.h"

namespace tetstream::cli {

static constexpr const char* kStandardFormat = "tets";  // of "-": the one that holds everything

std::string Place::name() const {
  return isStandard() ? "standard input" : path.substr(path.find_last_of('/') + 1);
}

[[noreturn]] static void failSystem(const std::string& path, const char* what) {
  const int error = errno;
  throw Failure{kIo, textOf("%s: cannot %s: %s", path.c_str(), what, std::strerror(error))};
}

static void checkDirectoryOf(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  const std::string directory = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  struct stat info;
  if (::stat(directory.c_str(), &info) != 0 || ::access(directory.c_str(), W_OK | X_OK) != 0)
    failSystem(path, "create");
}

static bool isTerminal(const std::string& path) {
  const int fd = ::open(path.c_str(), O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return false;
  const bool terminal = ::isatty(fd) == 1;
  ::close(fd);
  return terminal;
}

void checkOutput(const Place& out) {
  struct stat info;
  bool terminal = false;
  if (out.isStandard()) {
    terminal = ::isatty(STDOUT_FILENO) == 1;
  } else if (::stat(out.path.c_str(), &info) != 0) {
    checkDirectoryOf(out.path);
  } else if (S_ISDIR(info.st_mode)) {
    errno = EISDIR;
    failSystem(out.path, "create");
  } else if (S_ISREG(info.st_mode)) {
    checkDirectoryOf(out.path);  // the output is written beside and renamed
  } else {
    terminal = S_ISCHR(info.st_mode) && isTerminal(out.path);
  }
  if (terminal)
    throw Failure{kUsage,
                  "a mesh is not written to a terminal: give a file name, or send it to a file "
                  "or a pipe"};
}

bool isStandardOutput(const Place& out) {
  struct stat at_path, standard;
  return out.isStandard() ||
         (::stat(out.path.c_str(), &at_path) == 0 && ::fstat(STDOUT_FILENO, &standard) == 0 &&
          at_path.st_dev == standard.st_dev && at_path.st_ino == standard.st_ino);
}

bool isPipe(const Place& out) {
  struct stat info;
  return out.isStandard() && ::fstat(STDOUT_FILENO, &info) == 0 && S_ISFIFO(info.st_mode);
}

static const char* formatOf(const Place& place) {
  if (!place.format.empty()) return place.format.c_str();
  return place.isStandard() ? kStandardFormat : nullptr;
}

static void tell(const Options& options, ProgressBar& bar) {
  check(tetstream_options_set_progress(options.get(), ProgressBar::callback, &bar), options.get());
}

Reader openReader(const Place& in, const Options& options, ProgressBar& bar) {
  tell(options, bar);
  tetstream_reader* handle = nullptr;
  tetstream_status status;
  if (in.isStandard()) {
    if (::isatty(STDIN_FILENO) == 1)
      throw Failure{kUsage, "a mesh is not read from a terminal: give a file name or a pipe"};
    interruptTransfersOf(STDIN_FILENO);
    status = tetstream_reader_open_fd_with(STDIN_FILENO, formatOf(in), options.get(), &handle);
  } else {
    status = tetstream_reader_open_file_with(in.path.c_str(), formatOf(in), options.get(), &handle);
  }
  Reader reader(handle);
  check(status, handle);
  return reader;
}

// What comes through a pipe is read as it is: nothing can be tried twice.
static OptionWords withoutReading(OptionWords words) {
  for (const tetstream_option_info& info : optionTable())
    if (info.scope == TETSTREAM_SCOPE_READ)
      std::erase_if(words.values, [&](const auto& word) { return word.first == info.name; });
  return words;
}

Reader openResult(const Place& in, const OptionWords& words, ProgressBar& bar) {
  if (in.isStandard()) return openReader(in, makeOptions(withoutReading(words)), bar);
  const Options options = makeOptions(words);
  tell(options, bar);
  tetstream_reader* handle = nullptr;
  const tetstream_status status =
      tetstream_reader_open_result(in.path.c_str(), formatOf(in), options.get(), &handle);
  Reader reader(handle);
  check(status, handle);
  return reader;
}

Reader generateReader(const std::string& kind, int64_t cells, int64_t seed) {
  tetstream_reader* handle = nullptr;
  const tetstream_status status = tetstream_reader_generate(kind.c_str(), cells, seed, &handle);
  Reader reader(handle);
  check(status, handle);
  return reader;
}

// The library's sentence, with the flag where it speaks of the property.
static void setProperty(tetstream_writer* writer, const Property& property) {
  try {
    check(tetstream_writer_set(writer, property.name.c_str(), property.value.c_str()), writer);
  } catch (Failure& failure) {
    const std::string called = "property \"" + property.name + "\"";
    const size_t place = failure.text.find(called);
    if (place != std::string::npos) failure.text.replace(place, called.size(), property.flag);
    throw;
  }
}

Writer createWriter(const Place& out, const std::vector<Property>& properties) {
  tetstream_writer* handle = nullptr;
  tetstream_status status;
  if (out.isStandard()) {
    interruptTransfersOf(STDOUT_FILENO);
    status = tetstream_writer_create_fd(STDOUT_FILENO, formatOf(out), &handle);
  } else {
    status = tetstream_writer_create_file(out.path.c_str(), formatOf(out), &handle);
  }
  Writer writer(handle);
  check(status, handle);
  for (const Property& p : properties) setProperty(handle, p);
  return writer;
}

static constexpr const char* kStandardTraces = "csv";

void setMap(tetstream_simplifier* simplifier, const Place& map) {
  if (map.path.empty()) return;
  if (map.isStandard()) interruptTransfersOf(STDOUT_FILENO);
  check(map.isStandard()
            ? tetstream_simplifier_set_map_fd(simplifier, STDOUT_FILENO, kStandardTraces)
            : tetstream_simplifier_set_map_file(simplifier, map.path.c_str(), nullptr),
        simplifier);
}

void setLog(tetstream_simplifier* simplifier, const Place& log) {
  if (log.path.empty()) return;
  if (log.isStandard()) interruptTransfersOf(STDOUT_FILENO);
  check(log.isStandard()
            ? tetstream_simplifier_set_log_fd(simplifier, STDOUT_FILENO, kStandardTraces)
            : tetstream_simplifier_set_log_file(simplifier, log.path.c_str(), nullptr),
        simplifier);
}

std::vector<std::string> notesOf(const tetstream_reader* reader, const tetstream_writer* writer) {
  std::vector<std::string> notes;
  if (reader)
    for (int32_t i = 0; const char* note = tetstream_reader_note(reader, i); ++i)
      notes.emplace_back(note);
  if (writer)
    for (int32_t i = 0; const char* note = tetstream_writer_note(writer, i); ++i)
      notes.emplace_back(note);
  return notes;
}

}  // namespace tetstream::cli
