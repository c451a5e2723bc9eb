#include "exact_reference.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tetstream::test {
namespace {

// Sign and magnitude, 32 bits a limb, lowest first, no leading zeros.
struct Integer {
  bool negative = false;
  std::vector<uint32_t> limbs;
  bool isZero() const { return limbs.empty(); }
};

void trim(Integer& a) {
  while (!a.limbs.empty() && a.limbs.back() == 0) a.limbs.pop_back();
  if (a.limbs.empty()) a.negative = false;
}

int compareMagnitude(const Integer& a, const Integer& b) {
  if (a.limbs.size() != b.limbs.size()) return a.limbs.size() < b.limbs.size() ? -1 : 1;
  for (size_t i = a.limbs.size(); i-- > 0;)
    if (a.limbs[i] != b.limbs[i]) return a.limbs[i] < b.limbs[i] ? -1 : 1;
  return 0;
}

// |a| + |b|, or |a| - |b| where that is not negative.
Integer combine(const Integer& a, const Integer& b, bool subtract) {
  Integer out;
  int64_t carry = 0;
  for (size_t i = 0; i < std::max(a.limbs.size(), b.limbs.size()) || carry != 0; ++i) {
    const int64_t x = i < a.limbs.size() ? a.limbs[i] : 0, y = i < b.limbs.size() ? b.limbs[i] : 0;
    const int64_t sum = x + (subtract ? -y : y) + carry;
    out.limbs.push_back(static_cast<uint32_t>(sum & 0xffffffff));
    carry = sum >> 32;
  }
  trim(out);
  return out;
}

Integer add(const Integer& a, const Integer& b) {
  const bool same_sign = a.negative == b.negative, a_wins = compareMagnitude(a, b) >= 0;
  Integer out = same_sign ? combine(a, b, false)
                : a_wins  ? combine(a, b, true)
                          : combine(b, a, true);
  out.negative = !out.isZero() && (a_wins ? a.negative : b.negative);
  return out;
}

Integer minus(Integer a) {
  a.negative = !a.negative && !a.isZero();
  return a;
}

Integer multiply(const Integer& a, const Integer& b) {
  Integer out;
  out.limbs.assign(a.limbs.size() + b.limbs.size(), 0);
  for (size_t i = 0; i < a.limbs.size(); ++i) {
    uint64_t carry = 0;
    for (size_t j = 0; j < b.limbs.size() || carry != 0; ++j) {
      uint64_t sum = out.limbs[i + j] + carry;
      if (j < b.limbs.size()) sum += uint64_t{a.limbs[i]} * b.limbs[j];
      out.limbs[i + j] = static_cast<uint32_t>(sum);
      carry = sum >> 32;
    }
  }
  out.negative = a.negative != b.negative;
  trim(out);
  return out;
}

int exponentOf(double value) {
  int exponent = 0;
  std::frexp(value, &exponent);
  return exponent - 53;
}

// value / 2^lowest, a whole number.
Integer integerOf(double value, int lowest) {
  Integer out;
  if (value == 0) return out;
  int exponent;
  auto mantissa = static_cast<uint64_t>(std::ldexp(std::fabs(std::frexp(value, &exponent)), 53));
  const auto shift = static_cast<unsigned>(exponent - 53 - lowest);
  out.limbs.assign(shift / 32 + 3, 0);
  for (unsigned bit = 0; bit < 53; ++bit)
    if (mantissa >> bit & 1) out.limbs[(shift + bit) / 32] |= uint32_t{1} << (shift + bit) % 32;
  out.negative = value < 0;
  trim(out);
  return out;
}

}  // namespace

int referenceOrientation(const double a[3], const double b[3], const double c[3],
                         const double d[3]) {
  const double* const p[4] = {a, b, c, d};
  int lowest = 2000;
  for (const double* x : p)
    for (int i = 0; i < 3; ++i)
      if (x[i] != 0) lowest = std::min(lowest, exponentOf(x[i]));
  Integer e[3][3];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      e[k][i] = add(integerOf(p[k + 1][i], lowest), minus(integerOf(a[i], lowest)));
  Integer det;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Integer minor = add(multiply(e[1][j], e[2][k]), minus(multiply(e[1][k], e[2][j])));
    det = add(det, multiply(e[0][i], minor));
  }
  return det.isZero() ? 0 : det.negative ? -1 : 1;
}

}  // namespace tetstream::test
