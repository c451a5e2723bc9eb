// file/text: the numbers that nearly all of a text are, with blanks around them, read where they
// lie; what is not plain (a plus sign, Fortran's exponents, too many digits) is left to
// text_number.h. Depends on nothing.
#pragma once

#include <bit>
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

// Eight characters of a text, of which some are digits: what they are worth.
class EightDigits {
 public:
  explicit EightDigits(const char* at) {
    std::memcpy(&values_, at, sizeof values_);
    if constexpr (std::endian::native == std::endian::big) values_ = __builtin_bswap64(values_);
    values_ ^= 0x3030303030303030;  // of a digit its value, of all others more than 9
  }
  // How many digits stand in front.
  int count() const {
    // note: carries of what is no digit only reach what stands behind it.
    const uint64_t others = (values_ | (values_ + 0x7676767676767676)) & 0x8080808080808080;
    return std::countr_zero(others) >> 3;
  }
  // The number that the first `count` are, at most eight.
  uint64_t number(int count) const {
    // As the last of eight places. Pairs, then fours, then all: what stands in front, in the lower
    // bytes, counts so many times.
    uint64_t word = count == 8 ? values_ : values_ << 8 * (7 - count) << 8;
    word = word * 10 + (word >> 8);
    word = (word & 0x00FF00FF00FF00FF) * ((uint64_t{100} << 16) + 1) >> 16;
    return (word & 0x0000FFFF0000FFFF) * ((uint64_t{10000} << 32) + 1) >> 32;
  }

 private:
  uint64_t values_;
};

// Reads digits, at most 23, at the end of the decimal number in *number, which wraps around where
// there are too many. Returns their end; null: there are more.
inline const char* readDigits(const char* at, uint64_t* number) {
  static constexpr uint32_t powers[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000};
  for (int words = 0; words < 3; ++words, at += 8) {
    const EightDigits digits(at);
    const int count = digits.count();
    if (count < 8) {
      *number = *number * powers[count] + digits.number(count);
      return at + count;
    }
    *number = *number * 100000000 + digits.number(8);
  }
  return nullptr;
}

// The end of a whole number without a sign; null if there is none, or it has more than 18 digits.
inline const char* readPlain(const char* at, int64_t* value) {
  const EightDigits digits(at);
  const int count = digits.count();
  if (count == 0) return nullptr;
  uint64_t number = digits.number(count);
  const char* end = at + count;
  if (count == 8) {
    end = readDigits(end, &number);
    if (!end || end - at > 18) return nullptr;
  }
  *value = static_cast<int64_t>(number);
  return end;
}

// The end of a decimal number, which may have a point or an exponent, rounded to nearest, as the
// standard library does it; null: there is none, or it is too large or too small for the type.
const char* readPlain(const char* at, float* value);
const char* readPlain(const char* at, double* value);

}  // namespace tetstream
