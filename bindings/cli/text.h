// cli: numbers and lines for people. Depends on failure.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace tetstream::cli {

std::string textOf(const char* format, ...) __attribute__((format(printf, 1, 2)));

std::string countText(int64_t count);                   // "unknown" below 0
std::string shortCount(double count);                   // "12.3 M"
std::string clockText(double seconds);                  // "1:02:03", "0:07"
std::string megabytes(uint64_t bytes);                  // "14.2 MB", of 2^20 bytes
std::string exactText(double value);                    // shortest text that reads back the same
std::string_view typeName(int32_t type);                // "float32" of TETSTREAM_TYPE_FLOAT32
std::string row(const char* name, const std::string&);  // a line of a report, in two columns

// Lines of a list that a report tells to people, who look for the rest in JSON.
constexpr size_t kMostListed = 40;

// The text on one line: control characters, which file names may hold, become blanks.
std::string oneLine(std::string text);

// In characters, of the terminal; where the descriptor is none, what COLUMNS says, or 80.
size_t terminalWidth(int fd);

// To standard output, at once; throws Failure if it does not get there.
void printOut(const std::string& text);
// To standard error; nobody is left to be told of a failure.
void printError(std::string_view text);  // needs no memory
// "tetstream: note: ..." to standard error.
void printNote(const std::string& text);

}  // namespace tetstream::cli
