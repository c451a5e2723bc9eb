// Plain numbers of text: what is taken, and what is left to others.
#include <gtest/gtest.h>

#include <string>

#include "plain_number.h"

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

}  // namespace
}  // namespace tetstream
