// Plain numbers of text: what is taken, and what is left to others.
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <random>
#include <string>

#include "plain_number.h"
#include "slow_run.h"

namespace tetstream {
namespace {

// How many characters were taken, with more behind them; 0: it is not plain.
template <class Number>
size_t taken(const std::string& text, Number* value) {
  const std::string held = text + " 12345678" + std::string(kPlainNumberBytes, '7');
  const char* end = readPlain(held.data(), value);
  return end ? static_cast<size_t>(end - held.data()) : 0;
}

TEST(PlainNumber, DigitsOfAnyNumberOfPlacesAreRead) {
  int64_t value = -1;
  for (int first = 0; first < 10; ++first) {
    std::string text;
    for (int places = 1; places <= 18; ++places) {
      text += static_cast<char>('0' + (first + 7 * places) % 10);
      EXPECT_EQ(taken(text, &value), text.size());
      EXPECT_EQ(value, std::stoll(text));
    }
  }
  EXPECT_EQ(taken(std::string(19, '0'), &value), 0u);
  for (const char* other : {"", "-1", "+1", "x", "/", ":", ".5"})
    EXPECT_EQ(taken(std::string(other), &value), 0u) << other;
  for (int c = 0; c < 256; ++c) {  // any byte ends them
    const std::string ended = "123" + std::string(1, static_cast<char>(c));
    const bool digit = c >= '0' && c <= '9';
    EXPECT_EQ(taken(ended, &value), digit ? 4u : 3u) << c;
    EXPECT_EQ(value, digit ? 1230 + c - '0' : 123);
  }
}

TEST(PlainNumber, RealsAreThoseOfTheStandardLibrary) {
  double wide = 0;
  float narrow = 0;
  EXPECT_EQ(taken("-12.5e-3", &wide), 8u);
  EXPECT_EQ(wide, -12.5e-3);
  EXPECT_EQ(taken("0.1", &narrow), 3u);
  EXPECT_EQ(narrow, 0.1f);
  for (const char* other : {"", "-", ".", "e5", "+1", "1e999", "x"})
    EXPECT_EQ(taken(std::string(other), &wide), 0u) << other;
}

// The number of the standard library and its end, to the last bit, or none.
template <class Real>
void expectThatOfTheLibrary(const std::string& word) {
  const std::string held = word + std::string(kPlainNumberBytes + 1, '\n');
  Real found = 7, exact = 7;
  const char* const end = readPlain(held.data(), &found);
  const std::from_chars_result r =
      std::from_chars(held.data(), held.data() + kPlainNumberBytes, exact);
  ASSERT_EQ(end, r.ec == std::errc() ? r.ptr : nullptr) << word;
  ASSERT_TRUE(!end || std::memcmp(&found, &exact, sizeof exact) == 0) << word << " " << found;
}

void expectThoseOfTheLibrary(const std::string& word) {
  expectThatOfTheLibrary<double>(word);
  expectThatOfTheLibrary<float>(word);
}

std::string printed(const char* form, int digits, long double value) {
  char text[512];
  std::snprintf(text, sizeof text, form, digits, value);
  return text;
}

class RandomWords {
 public:
  size_t below(uint64_t limit) { return static_cast<size_t>(random_() % limit); }
  // Any double or float, with more digits than it has, or fewer.
  std::string any() {
    const uint64_t bits = random_();
    double wide;
    float narrow;
    std::memcpy(&wide, &bits, sizeof wide);
    std::memcpy(&narrow, &bits, sizeof narrow);
    return printed(below(2) ? "%.*Lg" : "%.*Le", static_cast<int>(below(25)),
                   below(2) ? static_cast<long double>(wide) : static_cast<long double>(narrow));
  }
  // Half way between two neighbours, or as near to it as so many digits are.
  template <class Real>
  std::string halfWay() {
    const auto low = static_cast<Real>(std::ldexp(
        1 + 0x1p-40 * static_cast<double>(below(1ull << 40)), static_cast<int>(below(120)) - 60));
    const Real high = std::nextafter(low, Real(1e30));
    return printed("%.*Lg", static_cast<int>(7 + below(40)),
                   (static_cast<long double>(low) + static_cast<long double>(high)) / 2);
  }
  std::string digits(size_t most) {
    std::string text;
    for (size_t i = below(most + 1); i > 0; --i)
      text += static_cast<char>('0' + (below(3) ? below(10) : 0));
    return text;
  }
  std::string written() {
    std::string text = (below(3) ? "" : "-") + digits(22) + (below(4) ? "." + digits(24) : "");
    const char* const letters[] = {"e", "E", "e-", "E+"};
    return below(2) ? text + letters[below(4)] + digits(5) : text;
  }
  std::string nonsense() {
    constexpr char kCharacters[] = "0123456789012345.eE-+ naifx";
    std::string text;
    for (size_t i = below(20); i > 0; --i) text += kCharacters[below(sizeof kCharacters - 1)];
    return text;
  }

 private:
  std::mt19937_64 random_{11};
};

TEST(PlainNumber, RealsAreThoseOfTheStandardLibraryToTheLastBit) {
  RandomWords random;
  for (int i = 0; i < (test::slowRun() ? 2000 : 20000) && !testing::Test::HasFatalFailure(); ++i) {
    expectThoseOfTheLibrary(random.any());
    expectThoseOfTheLibrary(random.halfWay<double>());
    expectThoseOfTheLibrary(random.halfWay<float>());
    expectThoseOfTheLibrary(random.written());
    expectThoseOfTheLibrary(random.nonsense());
  }
  for (const char* word : {"0",
                           "-0",
                           "0.0e0",
                           "9007199254740993",
                           "9007199254740992.5",
                           "9007199254740991.5",
                           "16777217",
                           "18446744073709551615",
                           "18446744073709551616",
                           "9999999999999999999",
                           "5e-324",
                           "2.4703282292062327e-324",
                           "2.4703282292062328e-324",
                           "2.2250738585072014e-308",
                           "2.2250738585072011e-308",
                           "1.7976931348623157e308",
                           "1.7976931348623159e308",
                           "3.4028235677973366e38",
                           "3.4028235677973362e38",
                           "1.17549435e-38",
                           "1e-45",
                           "7e-46",
                           "1.000000178813934326",
                           "1.000000178813934327",
                           "1e22",
                           "1e23",
                           "1e40",
                           "1e41",
                           "1e-64",
                           "1e-65",
                           "00000000000000000001",
                           "0.000000000000000000012345678901234567",
                           "1.",
                           ".5",
                           "1e",
                           "1e+",
                           "1.e5",
                           "1e00005",
                           "1e0000005",
                           "00000000000000000000000000000000000.5",
                           "0.1000000000000000055511151231257827021181583404541015625"})
    expectThoseOfTheLibrary(word);
}

}  // namespace
}  // namespace tetstream
