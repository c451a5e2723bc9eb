#include "text.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <tetstream/tetstream.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "failure.h"

namespace tetstream::cli {

std::string textOf(const char* format, ...) {
  va_list args, again;
  va_start(args, format);
  va_copy(again, args);
  const int length = std::vsnprintf(nullptr, 0, format, again);
  va_end(again);
  std::string text(length > 0 ? static_cast<size_t>(length) : 0, '\0');
  if (length > 0) std::vsnprintf(text.data(), text.size() + 1, format, args);
  va_end(args);
  return text;
}

std::string countText(int64_t count) {
  return count < 0 ? "unknown" : std::to_string(count);
}

std::string shortCount(double count) {
  static constexpr const char* kUnits[] = {"", " k", " M", " G", " T", " P"};
  size_t unit = 0;
  while (count >= 999.5 && unit + 1 < std::size(kUnits)) {
    count /= 1000;
    ++unit;
  }
  const int digits = unit == 0 || count >= 99.95 ? 0 : count >= 9.995 ? 1 : 2;
  return textOf("%.*f%s", digits, count, kUnits[unit]);
}

std::string clockText(double seconds) {
  // A rate of nearly nothing makes times that do not fit; nobody waits that long anyway.
  if (!(seconds < 3.6e6)) return "> 999 h";
  const long s = std::lround(seconds);
  if (s >= 3600) return textOf("%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  return textOf("%ld:%02ld", s / 60, s % 60);
}

std::string megabytes(uint64_t bytes) {
  return textOf("%.1f MB", static_cast<double>(bytes) / (1 << 20));
}

std::string exactText(double value) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value);
  return std::string(digits, end.ptr);
}

std::string_view typeName(int32_t type) {
  switch (type) {
    case TETSTREAM_TYPE_FLOAT32:
      return "float32";
    case TETSTREAM_TYPE_FLOAT64:
      return "float64";
    case TETSTREAM_TYPE_INT32:
      return "int32";
    case TETSTREAM_TYPE_INT64:
      return "int64";
    default:
      return "unknown";
  }
}

std::string row(const char* name, const std::string& value) {
  return textOf("%-14s%s\n", name, value.c_str());
}

std::string oneLine(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = ' ';
  return text;
}

size_t terminalWidth(int fd) {
  struct winsize size = {};
  if (::ioctl(fd, TIOCGWINSZ, &size) == 0 && size.ws_col > 1) return size.ws_col;
  const std::string_view columns = std::getenv("COLUMNS") ? std::getenv("COLUMNS") : "";
  size_t width = 0;
  std::from_chars(columns.data(), columns.data() + columns.size(), width);
  return width > 1 ? width : 80;
}

// Returns 0 or the error's number. Others may have made the descriptor one that does not wait.
static int writeAll(int fd, std::string_view text) {
  size_t done = 0;
  while (done < text.size()) {
    const ssize_t put = ::write(fd, text.data() + done, text.size() - done);
    if (put > 0) {
      done += static_cast<size_t>(put);
    } else if (put < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      struct pollfd writable = {fd, POLLOUT, 0};
      ::poll(&writable, 1, -1);
    } else if (put < 0 && errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

void printOut(const std::string& text) {
  const int error = writeAll(STDOUT_FILENO, text);
  if (error != 0)
    throw Failure{kIo, textOf("standard output: cannot write: %s", std::strerror(error))};
}

void printError(std::string_view text) {
  writeAll(STDERR_FILENO, text);
}

void printNote(const std::string& text) {
  printError("tetstream: note: " + oneLine(text) + "\n");
}

}  // namespace tetstream::cli
