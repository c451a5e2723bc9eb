// file: the words and numbers of an .sva line. Depends on scalar.h.
#pragma once

#include <cstdint>
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

// The shortest text that reads back as the same number.
void printNumber(const void* value, ScalarType type, std::string& out);
void printInteger(int64_t value, std::string& out);

// The word for a message: at most 32 characters, those that do not print as '?'.
std::string quoted(std::string_view word);

}  // namespace tetstream
