#include "plain_number.h"

#include <array>
#include <charconv>

namespace tetstream {

namespace {

// What the standard library reads, and anything else that is rare.
template <class Real>
[[gnu::noinline]] const char* readByLibrary(const char* at, Real* value) {
  const std::from_chars_result r = std::from_chars(at, at + kPlainNumberBytes, *value);
  return r.ec == std::errc() ? r.ptr : nullptr;
}

#ifdef __SIZEOF_INT128__

__extension__ using Wide = unsigned __int128;

// 10^e = significand 2^exponent, and less than 1 + 2^-50 more in the significand, whose highest bit
// is set.
struct PowerOfTen {
  uint64_t significand;
  int exponent;
};

// Numbers of 19 digits that a float holds, and what files of doubles have but for a few.
constexpr int kLeastPower = -64, kMostPower = 40;
using Powers = std::array<PowerOfTen, kMostPower - kLeastPower + 1>;

// In 128 bits, of which each step loses less than four at the end.
constexpr Powers makePowers() {
  Powers powers{};
  for (const int sign : {1, -1}) {
    Wide significand = Wide{1} << 127;
    int exponent = -127;
    for (int e = 0; e >= kLeastPower && e <= kMostPower; e += sign) {
      powers[static_cast<size_t>(e - kLeastPower)] = {static_cast<uint64_t>(significand >> 64),
                                                      exponent + 64};
      if (sign > 0) {
        significand = (significand >> 4) * 10;
        exponent += 4;
      } else {
        significand /= 10;
      }
      for (; !(significand >> 127); --exponent) significand <<= 1;
    }
  }
  return powers;
}

constexpr Powers kPowers = makePowers();

template <class Real>
struct Layout;
template <>
struct Layout<double> {
  using Bits = uint64_t;
  static constexpr int kSignificand = 53, kBias = 1023;
};
template <>
struct Layout<float> {
  using Bits = uint32_t;
  static constexpr int kSignificand = 24, kBias = 127;
};

// number 10^power, number > 0, rounded to nearest; false: this cannot tell, or it is not normal.
//
// The product of both significands, each of 64 bits, is kept to its upper 64, 63 of which count at
// least. The number itself is less than 1 + 1 + 2^-50 above them: 1 for what was cut off, the rest
// for the power of ten. So it is known on which side of the middle between two neighbours it lies
// unless they are the middle, or 1 or 2 below it.
template <class Real>
bool round(uint64_t number, int power, bool negative, Real* value) {
  using Its = Layout<Real>;
  if (power < kLeastPower || power > kMostPower) return false;
  const PowerOfTen& ten = kPowers[static_cast<size_t>(power - kLeastPower)];
  const int zeros = std::countl_zero(number);
  const auto upper = static_cast<uint64_t>(Wide{number << zeros} * ten.significand >> 64);
  const int below = std::bit_width(upper) - Its::kSignificand;  // bits that are rounded
  const uint64_t half = uint64_t{1} << (below - 1);
  const uint64_t rest = upper & (2 * half - 1);
  if (half - rest <= 2) return false;  // note: wraps around where the rest is larger
  // value = (upper >> below) 2^(below + 64 + ten.exponent - zeros)
  const int exponent = below + 64 + ten.exponent - zeros + (Its::kSignificand - 1) + Its::kBias;
  if (exponent < 1 || exponent > 2 * Its::kBias - 1) return false;
  // The highest bit of the significand adds 1 to the exponent, as does one that rounding carries.
  const uint64_t significand = (upper >> below) + (rest > half);
  const auto bits = static_cast<typename Its::Bits>(
      (static_cast<uint64_t>(exponent - 1) << (Its::kSignificand - 1)) + significand);
  std::memcpy(value, &bits, sizeof bits);
  if (negative) *value = -*value;
  return true;
}

// Of `digits` characters, one of which may be a point: whether the number that they are is below
// 10^19, and so was not cut off.
bool isShort(const char* at, ptrdiff_t digits) {
  for (; digits > 19 && (*at == '0' || *at == '.'); ++at) digits -= *at == '0';
  return digits <= 19;
}

unsigned digitOf(char c) {
  return static_cast<unsigned char>(c) - unsigned{'0'};
}

// The exponent behind its letter; null: it is none, or has more than four digits.
const char* readExponent(const char* at, int* exponent) {
  const bool negative = *at == '-';
  at += negative || *at == '+';
  const unsigned tens = digitOf(at[0]), ones = digitOf(at[1]);
  if (tens < 10 && ones < 10 && digitOf(at[2]) > 9) {  // nearly all
    const auto number = static_cast<int>(10 * tens + ones);
    *exponent = negative ? -number : number;
    return at + 2;
  }
  const EightDigits digits(at);
  const int count = digits.count();
  if (count == 0 || count > 4) return nullptr;
  const auto number = static_cast<int>(digits.number(count));
  *exponent = negative ? -number : number;
  return at + count;
}

template <class Real>
const char* readReal(const char* at, Real* value) {
  const bool negative = *at == '-';
  const char* const first = at + negative;
  uint64_t number = digitOf(*first);
  const char* end = first + 1;
  if (number > 9 || *end != '.') {  // nearly all have one digit and a point
    number = 0;
    end = readDigits(first, &number);
  }
  if (!end) return readByLibrary(at, value);
  ptrdiff_t digits = end - first;
  int power = 0;
  if (*end == '.') {
    const char* const behind_point = end + 1;
    end = readDigits(behind_point, &number);
    if (!end) return readByLibrary(at, value);
    power = -static_cast<int>(end - behind_point);
    digits -= power;
  }
  if (digits == 0 || (digits > 19 && !isShort(first, digits))) return readByLibrary(at, value);
  if (*end == 'e' || *end == 'E') {
    int exponent = 0;
    end = readExponent(end + 1, &exponent);
    if (!end) return readByLibrary(at, value);
    power += exponent;
  }
  if (number == 0)
    *value = negative ? -Real{0} : Real{0};
  else if (!round(number, power, negative, value))
    return readByLibrary(at, value);
  return end;
}

#else

template <class Real>
const char* readReal(const char* at, Real* value) {
  return readByLibrary(at, value);
}

#endif

}  // namespace

const char* readPlain(const char* at, float* value) {
  return readReal(at, value);
}

const char* readPlain(const char* at, double* value) {
  return readReal(at, value);
}

}  // namespace tetstream
