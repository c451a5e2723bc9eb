#include "failure.h"

namespace tetstream::cli {

ExitCode exitCodeOf(tetstream_status status) {
  switch (status) {
    case TETSTREAM_OK:
    case TETSTREAM_END:
      return kOk;
    case TETSTREAM_TARGET_MISSED:
      return kTargetMissed;
    case TETSTREAM_BAD_ARGUMENT:
      return kUsage;
    case TETSTREAM_NO_MEMORY:
      return kNoMemory;
    case TETSTREAM_BAD_DATA:
      return kBadData;
    case TETSTREAM_IO:
      return kIo;
    case TETSTREAM_UNSUPPORTED:
      return kUnsupported;
    case TETSTREAM_CANCELLED:
      return kCancelled;
    default:  // the command uses no callbacks of its own and calls in order
      return kInternal;
  }
}

// The library names the function that was misused; nobody called one here.
static std::string withoutFunction(std::string text) {
  const size_t colon = text.find(": ");
  if (text.rfind("tetstream_", 0) != 0 || colon == std::string::npos) return text;
  if (text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != colon) return text;
  return text.substr(colon + 2);
}

[[noreturn]] static void fail(tetstream_status status, const char* message) {
  const bool is_misuse = status == TETSTREAM_BAD_ARGUMENT || status == TETSTREAM_BAD_STATE;
  std::string text = message ? message : "";
  if (is_misuse) text = withoutFunction(std::move(text));
  if (text.empty())
    text = status == TETSTREAM_NO_MEMORY ? "out of memory" : tetstream_status_name(status);
  throw Failure{exitCodeOf(status), std::move(text)};
}

void check(tetstream_status status) {
  if (status < 0) fail(status, nullptr);
}

void check(tetstream_status status, const tetstream_options* options) {
  if (status < 0) fail(status, options ? tetstream_options_message(options) : nullptr);
}

void check(tetstream_status status, const tetstream_reader* reader) {
  if (status < 0) fail(status, reader ? tetstream_reader_message(reader) : nullptr);
}

void check(tetstream_status status, const tetstream_writer* writer) {
  if (status < 0) fail(status, writer ? tetstream_writer_message(writer) : nullptr);
}

void check(tetstream_status status, const tetstream_simplifier* simplifier) {
  if (status < 0) fail(status, simplifier ? tetstream_simplifier_message(simplifier) : nullptr);
}

void check(tetstream_status status, const tetstream_diagram* diagram) {
  if (status < 0) fail(status, diagram ? tetstream_diagram_message(diagram) : nullptr);
}

void check(tetstream_status status, const tetstream_comparison* comparison) {
  if (status < 0) fail(status, comparison ? tetstream_comparison_message(comparison) : nullptr);
}

}  // namespace tetstream::cli
