// file/text: words and numbers of text. Depends on scalar.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scalar.h"

namespace tetstream {

// Takes the next blank-separated word off the front of `rest`; empty at the end.
inline std::string_view takeWord(std::string_view& rest) {
  size_t begin = 0;
  while (begin < rest.size() && (rest[begin] == ' ' || rest[begin] == '\t')) ++begin;
  size_t end = begin;
  while (end < rest.size() && rest[end] != ' ' && rest[end] != '\t') ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(end);
  return word;
}

// The whole word as a number of that type, rounded to nearest. False: it is none, or an integer
// that does not fit. A float too large for the type becomes infinite.
bool parseNumber(std::string_view word, ScalarType type, void* out);
bool parseInteger(std::string_view word, int64_t* out);

// Whether a decimal number out of a type's range is below it and not above.
bool isTiny(std::string_view word);

// The number that stands at `begin`, as all but .sva has them: a plus sign may stand before it, and
// a real one may have Fortran's exponent, as in 1.5D+03. Returns the end of the word, which is at
// the first blank or at `end`; null: it is no such number.
const char* readWord(const char* begin, const char* end, int64_t* value);
const char* readWord(const char* begin, const char* end, double* value);

// The one real number of a text, such as a word of a markup, likewise; blanks may stand round it.
std::optional<double> realIn(std::string_view text);

// The shortest text that reads back as the same number.
void printNumber(const void* value, ScalarType type, std::string& out);
void printInteger(int64_t value, std::string& out);

// The word for a message: at most 32 characters, those that do not print as '?'.
std::string quoted(std::string_view word);

}  // namespace tetstream
