// file: the numbers that nearly all of a text are, read faster than any number can be: what is not
// plain is left to text_number.h. Depends on nothing.
#pragma once

#include <bit>
#include <cfloat>
#include <cstdint>
#include <cstring>

namespace tetstream {

// Bytes from a number's first on that are looked at, whatever they are; they must be there.
constexpr size_t kPlainNumberBytes = 64;

namespace plain_number {

constexpr int kMostDigits = 18, kMostRealDigits = 19;  // below 2^63, 2^64
constexpr uint64_t kMostExact = uint64_t{1} << 53;     // all up to it are doubles
constexpr uint64_t kWholePowers[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
constexpr double kExactPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// How many of the next eight characters are digits, up to the first that is none, and their number.
inline int digitsAt(const char* at, uint64_t* number) {
  if constexpr (std::endian::native == std::endian::little) {
    uint64_t word;
    std::memcpy(&word, at, sizeof word);
    word ^= 0x3030303030303030;
    // note: what is carried goes to characters behind the first that is no digit.
    const uint64_t others = (word | (word + 0x0606060606060606)) & 0xF0F0F0F0F0F0F0F0;
    const int count = others ? std::countr_zero(others) / 8 : 8;
    if (count == 0) return 0;
    word <<= 64 - 8 * count;  // zeros in front of them
    // Pairs, then fours, then all: what stands in front, in the lower bytes, counts so many times.
    word = word * 10 + (word >> 8);
    word = (word & 0x00FF00FF00FF00FF) * ((uint64_t{100} << 16) + 1) >> 16;
    word = (word & 0x0000FFFF0000FFFF) * ((uint64_t{10000} << 32) + 1) >> 32;
    *number = word;
    return count;
  } else {
    int count = 0;
    *number = 0;
    for (unsigned d; count < 8 && (d = static_cast<unsigned>(at[count] - '0')) < 10; ++count)
      *number = 10 * *number + d;
    return count;
  }
}

// Takes up to 24 digits, behind those of *number, which wraps around if they are too many for it.
// Returns how many.
inline int takeDigits(const char*& at, uint64_t* number) {
  int total = 0;
  for (int i = 0; i < 3; ++i) {
    uint64_t some = 0;
    const int count = digitsAt(at, &some);
    if (count > 0) *number = *number * kWholePowers[count] + some;
    at += count;
    total += count;
    if (count < 8) break;
  }
  return total;
}

#ifdef __SIZEOF_INT128__
// number / 10^places, number not 0, rounded to nearest: of the quotient 63 bits or more are found,
// and the lowest says besides whether anything is left.
inline double quotient(uint64_t number, int places) {
  __extension__ using Wide = unsigned __int128;
  uint64_t divisor = kWholePowers[places % 8];
  for (int i = places / 8; i > 0; --i) divisor *= kWholePowers[8];
  const int shift = 63 - std::bit_width(number) + std::bit_width(divisor);
  const Wide shifted = Wide{number} << shift;
  const auto whole = static_cast<uint64_t>(shifted / divisor);
  const uint64_t left = static_cast<uint64_t>(shifted) - whole * divisor;
  // 2^-shift, by its bits.
  return static_cast<double>(whole | (left != 0)) *
         std::bit_cast<double>(static_cast<uint64_t>(1023 - shift) << 52);
}
#endif

}  // namespace plain_number

// The end of the digits that begin here, and what they are; null if there are none or too many.
inline const char* readPlainDigits(const char* at, int64_t* value) {
  uint64_t number = 0;
  int digits = plain_number::digitsAt(at, &number);
  at += digits;
  if (digits == 8) digits += plain_number::takeDigits(at, &number);
  if (digits == 0 || digits > plain_number::kMostDigits) return nullptr;
  *value = static_cast<int64_t>(number);
  return at;
}

// The same of a number like -12.5e-3, rounded to nearest. Null: it is another one, or long.
inline const char* readPlainReal(const char* at, double* value) {
  using namespace plain_number;
  const bool negative = *at == '-';
  at += negative;
  uint64_t number = 0;
  int digits = takeDigits(at, &number);
  int64_t exponent = 0;
  if (digits <= kMostDigits && *at == '.') {
    ++at;
    const int places = takeDigits(at, &number);
    digits += places;
    exponent = -places;
  }
  if (digits == 0 || digits > kMostRealDigits) return nullptr;
  if (*at == 'e' || *at == 'E') {
    ++at;
    const bool below = *at == '-';
    at += below || *at == '+';
    uint64_t given = 0;
    const int count = takeDigits(at, &given);
    if (count == 0 || count > 3) return nullptr;
    exponent += below ? -static_cast<int64_t>(given) : static_cast<int64_t>(given);
  }
  double size;
  if (FLT_EVAL_METHOD == 0 && number <= kMostExact && exponent >= -22 && exponent <= 22) {
    // Both are exact, so the product or the quotient is rounded but once (W. D. Clinger, How to
    // Read Floating Point Numbers Accurately, 1990).
    const auto exact = static_cast<double>(number);
    size = exponent < 0 ? exact / kExactPowers[-exponent] : exact * kExactPowers[exponent];
#ifdef __SIZEOF_INT128__
  } else if (number > 0 && exponent >= -19 && exponent <= 0) {
    size = quotient(number, static_cast<int>(-exponent));
#endif
  } else {
    return nullptr;
  }
  *value = negative ? -size : size;
  return at;
}

}  // namespace tetstream
