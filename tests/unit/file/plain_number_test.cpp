// Plain numbers of text: the same, bit for bit, as the standard library's.
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>

#include "plain_number.h"

namespace tetstream {
namespace {

// With what may be read behind it.
std::string padded(const std::string& text) {
  return text + " 12345678" + std::string(kPlainNumberBytes, '7');
}

// How many characters were taken; 0: it is not plain.
template <class Number>
size_t taken(const char* (*read)(const char*, Number*), const std::string& text, Number* value) {
  const std::string held = padded(text);
  const char* end = read(held.data(), value);
  return end ? static_cast<size_t>(end - held.data()) : 0;
}

// True if it was plain.
bool agrees(const std::string& text) {
  double found = -1, wanted = -1;
  const size_t size = taken(readPlainReal, text, &found);
  if (size == 0) return false;
  std::from_chars(text.data(), text.data() + text.size(), wanted);
  EXPECT_EQ(size, text.size()) << text;
  EXPECT_EQ(std::memcmp(&found, &wanted, sizeof found), 0) << text << " " << found;
  return true;
}

TEST(PlainNumber, DigitsOfAnyNumberOfPlacesAreRead) {
  std::string text;
  for (int places = 1; places <= 18; ++places) {
    text += static_cast<char>('0' + places % 10);
    int64_t value = -1;
    EXPECT_EQ(taken(readPlainDigits, text, &value), text.size());
    EXPECT_EQ(value, std::stoll(text));
  }
  int64_t value;
  EXPECT_EQ(taken(readPlainDigits, std::string("0000000000000000000"), &value), 0u);  // 19
  for (const char* other : {"", "-1", "+1", "x", "/", ":", ".5"})
    EXPECT_EQ(taken(readPlainDigits, std::string(other), &value), 0u) << other;
  for (int c = 0; c < 256; ++c) {  // any byte ends them
    const std::string ended = "123" + std::string(1, static_cast<char>(c));
    const bool digit = c >= '0' && c <= '9';
    EXPECT_EQ(taken(readPlainDigits, ended, &value), digit ? 4u : 3u) << c;
    EXPECT_EQ(value, digit ? 1230 + c - '0' : 123);
  }
}

TEST(PlainNumber, RealsAreThoseOfTheStandardLibrary) {
  for (const char* text : {"0",
                           "-0",
                           "0.0",
                           "1",
                           "-1.5",
                           "12.",
                           ".5",
                           "1e22",
                           "1e-22",
                           "9007199254740992",
                           "9007199254740993.0",
                           "9007199254740993",
                           "0.26445066928863525",
                           "8.5e-3",
                           "1E+5",
                           "1234567890123456789",
                           "1844674407370955.161",
                           "0.999999999999999999",
                           "1.7976931348623157e0",
                           "4503599627370496.5",
                           "4503599627370497.5",
                           "0.1e0"})
    EXPECT_TRUE(agrees(text)) << text;
  for (const char* text : {"", "-", ".", "e5", "1e", "1e+", "1e1234", "1e23", "nan", "inf", "+1",
                           "--1", "12345678901234567890", "18446744073709551.615",
                           "0.9999999999999999999", "0.12345678901234567890123456789012"})
    EXPECT_FALSE(agrees(text)) << text;
}

TEST(PlainNumber, RandomRealsAreThoseOfTheStandardLibrary) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  int plain = 0;
  constexpr int kTries = 60000;
  for (int i = 0; i < kTries; ++i) {
    const double value = std::ldexp(unit(random), static_cast<int>(random() % 40) - 20);
    char text[64];
    const char* const forms[] = {"%.17g", "%.9g", "%.16f", "%.3e", "%.12f"};
    std::snprintf(text, sizeof text, forms[i % 5], value);
    plain += agrees(text);
  }
  EXPECT_GT(plain, kTries * 8 / 10);
  // Halves of the last place, and numbers next to them: 2^52 + k + 1/2 with many places.
  for (int i = 0; i < 20000; ++i) {
    const uint64_t whole = (uint64_t{1} << 52) + random() % (uint64_t{1} << 52);
    for (const char* end : {".5", ".50", ".49", ".51"})
      EXPECT_TRUE(agrees(std::to_string(whole) + end));
  }
}

}  // namespace
}  // namespace tetstream
