// file: the numbers that nearly all of a text are, with blanks around them, read where they lie;
// what is not plain (a plus sign, Fortran's exponents, too many digits) is left to text_number.h.
// Depends on nothing.
#pragma once

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace tetstream {

// What parts words of text.
inline bool isBlank(char c) {
  constexpr uint64_t blanks =
      uint64_t{1} << ' ' | uint64_t{1} << '\n' | uint64_t{1} << '\t' | uint64_t{1} << '\r';
  const auto code = static_cast<unsigned char>(c);
  return code <= ' ' && (blanks >> code & 1);
}

// Bytes from a number's first on that may be looked at, whatever they are; they must be there.
constexpr size_t kPlainNumberBytes = 64;

// The end of a whole number without a sign; null if there is none, or it has more than 18 digits.
inline const char* readPlain(const char* at, int64_t* value) {
  const auto digit = [](char c) { return static_cast<unsigned>(c - '0'); };
  const char* end = at;
  while (digit(*end) < 10 && end - at <= 18) ++end;
  const auto count = end - at;
  if (count == 0 || count > 18) return nullptr;
  if (std::endian::native != std::endian::little || count > 8) {
    uint64_t number = 0;
    for (; at < end; ++at) number = 10 * number + digit(*at);
    *value = static_cast<int64_t>(number);
    return end;
  }
  // All digits at once, as those of a number of eight places.
  uint64_t word;
  std::memcpy(&word, at, sizeof word);
  word = (word ^ 0x3030303030303030) << (64 - 8 * count);
  // Pairs, then fours, then all: what stands in front, in the lower bytes, counts so many times.
  word = word * 10 + (word >> 8);
  word = (word & 0x00FF00FF00FF00FF) * ((uint64_t{100} << 16) + 1) >> 16;
  word = (word & 0x0000FFFF0000FFFF) * ((uint64_t{10000} << 32) + 1) >> 32;
  *value = static_cast<int64_t>(word);
  return end;
}

// The same of a number with a point or an exponent, as the standard library reads it.
template <class Real>
const char* readPlainReal(const char* at, Real* value) {
  const std::from_chars_result r = std::from_chars(at, at + kPlainNumberBytes, *value);
  return r.ec == std::errc() ? r.ptr : nullptr;
}
inline const char* readPlain(const char* at, float* value) {
  return readPlainReal(at, value);
}
inline const char* readPlain(const char* at, double* value) {
  return readPlainReal(at, value);
}

}  // namespace tetstream
