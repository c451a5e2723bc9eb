// Arrays that stand in a file as text.
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

#include "slow_run.h"
#include "status.h"
#include "values.h"

namespace tetstream {
namespace {

struct Text {
  explicit Text(const std::string& words) : text(words) {}
  std::unique_ptr<Values> open(ValueType type, uint64_t count) const {
    return openTextValues(*bytes, "numbers", type, {0, text.size(), count});
  }
  std::string text;
  std::unique_ptr<ByteSource> bytes = openMemory(text.data(), text.size(), "memory");
};

// Longer than any buffer, in all forms.
std::vector<std::string> someReals(size_t count) {
  std::mt19937_64 random(3);
  std::vector<std::string> words;
  const char* const forms[] = {"%.9g", "%.17g", "%.4e", "%.25f", "%+.3f"};
  for (size_t i = 0; i < count; ++i) {
    uint64_t bits = random();
    float value;
    std::memcpy(&value, &bits, sizeof value);
    if (!(value > -1e30f && value < 1e30f)) value = 0.5f;
    if (i % 3 > 0) value = static_cast<float>(random() % 100000) / 1000;
    char word[128];
    std::snprintf(word, sizeof word, forms[i % 5], static_cast<double>(value));
    words.emplace_back(word);
  }
  return words;
}

template <class Real>
void expectThoseOfTheLibrary(ValueType type, ScalarType wanted) {
  const std::vector<std::string> words = someReals(test::slowRun() ? 15000 : 50000);
  std::string text;
  for (size_t i = 0; i < words.size(); ++i) text += words[i] + (i % 7 == 6 ? " \r\n" : " ");
  const Text file(text);
  const std::unique_ptr<Values> values = file.open(type, words.size());
  std::vector<Real> found(words.size());
  for (size_t at = 0; at < found.size(); at += 1000) values->read(at, 1000, &found[at], wanted);
  for (size_t i = 0; i < words.size(); ++i) {
    const char* begin = words[i].c_str() + (words[i][0] == '+');
    Real exact = 0;
    std::from_chars(begin, begin + std::strlen(begin), exact);
    ASSERT_EQ(std::memcmp(&found[i], &exact, sizeof exact), 0) << words[i] << " " << found[i];
  }
  for (const size_t at :
       {words.size() * 4 / 5, size_t{3}, size_t{12345}, size_t{12346}}) {  // not in order
    Real one;
    values->read(at, 1, &one, wanted);
    EXPECT_EQ(one, found[at]);
  }
}

TEST(AsciiValues, RealsAreThoseOfTheStandardLibrary) {
  expectThoseOfTheLibrary<float>(ValueType::kFloat32, ScalarType::kFloat32);
  expectThoseOfTheLibrary<double>(ValueType::kFloat64, ScalarType::kFloat64);
}

// However they are written: with no exponent, or with one that is below 0.
TEST(AsciiValues, FloatsThatAreTooSmallAreNone) {
  const std::string zeros(60, '0'), behind(100, ' ');
  const Text file("0." + zeros + "1 -0." + zeros + "1 1" + zeros + "e-120 1 0." + zeros + "1e+5" +
                  behind);
  float found[5];
  file.open(ValueType::kFloat32, 5)->read(0, 5, found, ScalarType::kFloat32);
  EXPECT_EQ(found[0], 0);
  EXPECT_TRUE(std::signbit(found[1]));
  EXPECT_EQ(found[1], 0);
  EXPECT_EQ(found[2], 0);
  EXPECT_EQ(found[3], 1);
  EXPECT_EQ(found[4], 0);
  const Text large("1" + zeros + "e-5" + behind);
  const auto values = large.open(ValueType::kFloat32, 1);
  EXPECT_THROW(values->read(0, 1, found, ScalarType::kFloat32), Error);
}

// The double next to the first is half way between two floats, the number itself is not.
TEST(AsciiValues, FloatsAreRoundedOnce) {
  const std::string behind(100, ' ');
  const Text file("1.000000178813934326 1.000000178813934327 1e-46 0 -0 3.4028235e38" + behind);
  float found[6];
  file.open(ValueType::kFloat32, 6)->read(0, 6, found, ScalarType::kFloat32);
  EXPECT_EQ(found[0], 1 + 0x1p-23f);
  EXPECT_EQ(found[1], 1 + 0x1p-22f);
  EXPECT_EQ(found[2], 0);
  EXPECT_EQ(found[5], 3.40282347e38f);
}

TEST(AsciiValues, IntegersThatDoNotFitAreRefused) {
  const std::string behind(100, '\n');
  const Text file("1 -7 2147483647 2147483648 9223372036854775807" + behind);
  const auto values = file.open(ValueType::kInt64, 5);
  int64_t wide[5];
  values->read(0, 5, wide, ScalarType::kInt64);
  EXPECT_EQ(wide[1], -7);
  EXPECT_EQ(wide[4], INT64_MAX);
  int32_t narrow[4];
  values->read(0, 3, narrow, ScalarType::kInt32);
  EXPECT_EQ(narrow[2], INT32_MAX);
  EXPECT_THROW(values->read(0, 4, narrow, ScalarType::kInt32), Error);
  int64_t one;
  EXPECT_THROW(
      Text("12x" + behind).open(ValueType::kInt64, 1)->read(0, 1, &one, ScalarType::kInt64), Error);
  EXPECT_THROW(
      Text("1 2" + behind).open(ValueType::kInt64, 1)->read(0, 1, &one, ScalarType::kInt64), Error);
}

}  // namespace
}  // namespace tetstream
