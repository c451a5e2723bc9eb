#include "status.h"

#include <locale.h>

#include <cstdarg>
#include <cstdio>
#include <utility>

namespace tetstream {

// As vsnprintf, with a point before decimals and nothing between thousands, whatever the locale of
// the process or of its thread is.
static int print(char* out, size_t size, const char* format, va_list args) {
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);  // as long as the process
  const locale_t before = ::uselocale(plain);
  const int length = std::vsnprintf(out, size, format, args);
  ::uselocale(before);
  return length;
}

static std::string vtext(const char* format, va_list args) {
  va_list again;
  va_copy(again, args);
  const int length = print(nullptr, 0, format, again);
  va_end(again);
  std::string text(length > 0 ? static_cast<size_t>(length) : 0, '\0');
  if (length > 0) print(text.data(), text.size() + 1, format, args);
  return text;
}

std::string textOf(const char* format, ...) {
  va_list args;
  va_start(args, format);
  std::string text = vtext(format, args);
  va_end(args);
  return text;
}

void fail(Status status, const char* format, ...) {
  va_list args;
  va_start(args, format);
  std::string text = vtext(format, args);
  va_end(args);
  throw Error(status, std::move(text));
}

const char* statusName(Status status) noexcept {
  switch (status) {
    case Status::kOk:
      return "TETSTREAM_OK";
    case Status::kEnd:
      return "TETSTREAM_END";
    case Status::kTargetMissed:
      return "TETSTREAM_TARGET_MISSED";
    case Status::kBadArgument:
      return "TETSTREAM_BAD_ARGUMENT";
    case Status::kBadState:
      return "TETSTREAM_BAD_STATE";
    case Status::kNoMemory:
      return "TETSTREAM_NO_MEMORY";
    case Status::kBadData:
      return "TETSTREAM_BAD_DATA";
    case Status::kIo:
      return "TETSTREAM_IO";
    case Status::kUnsupported:
      return "TETSTREAM_UNSUPPORTED";
    case Status::kCancelled:
      return "TETSTREAM_CANCELLED";
    case Status::kCallback:
      return "TETSTREAM_CALLBACK";
    case Status::kInternal:
      return "TETSTREAM_INTERNAL";
  }
  return "TETSTREAM_UNKNOWN_STATUS";
}

}  // namespace tetstream
