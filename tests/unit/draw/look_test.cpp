// Numbers and letters as they are written on a page.
#include "look.h"

#include <gtest/gtest.h>
#include <cmath>

#include "drawable_text.h"

namespace tetstream::test {
namespace {

TEST(Look, GroupsDigitsByThree) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1234567), "1\u2009234\u2009567");
  EXPECT_EQ(grouped(-123456), "-123\u2009456");
  EXPECT_EQ(groupedMean(12.34), "12.3");
  EXPECT_EQ(groupedMean(12345.6), "12\u2009346");
}

TEST(Look, PutsTicksAtRoundNumbers) {
  for (double end : {1.0, 3.0, 42.0, 99999.0, 1e6, 123456789.0, 4e12})
    for (int wanted : {2, 6, 10}) {
      const std::vector<Tick> ticks = ticksUpTo(end, wanted);
      ASSERT_FALSE(ticks.empty());
      EXPECT_EQ(ticks[0].at, 0);
      EXPECT_EQ(ticks[0].label, "0");
      EXPECT_LE(ticks.back().at, end);
      EXPECT_LE(ticks.size(), static_cast<size_t>(wanted) + 1);
      EXPECT_TRUE(end <= 3 || ticks.size() > static_cast<size_t>(wanted) / 3);
    }
  EXPECT_EQ(ticksUpTo(1.2e6, 6)[1].label, "200\u2009k");
  EXPECT_EQ(ticksUpTo(1.2e6, 6)[6].label, "1.2\u2009M");
  EXPECT_EQ(ticksUpTo(3, 2)[1].label, "2");
}

// Between numbers that differ in their last bits only there is nothing to be told.
TEST(Ticks, EndBetweenAnyTwoNumbers) {
  for (double low : {-3.0, 0.0, 1e-300, 101325.0, 1e17, 1e300})
    for (double high : {std::nextafter(low, 1e308), low + 16, low * (1 + 1e-12), 2 * low, 1e308}) {
      const std::vector<Tick> ticks = ticksBetween(low, high, 4);
      EXPECT_GE(ticks.size(), 1u) << low << " " << high;
      EXPECT_LE(ticks.size(), 10u) << low << " " << high;
    }
  const auto last = [](double high) { return ticksBetween(0, high, 4).back().label; };
  EXPECT_EQ(last(108), "100");
  EXPECT_EQ(last(21000), "20000");
  EXPECT_EQ(last(210000), "2e+05");
  EXPECT_EQ(last(0.0021), "0.002");
  EXPECT_EQ(ticksBetween(101325, std::nextafter(101325, 2e5), 4)[0].label, "1.013e+05");
}

TEST(DrawableText, KeepsLettersOfAnyLanguage) {
  const std::string text = "mesh \xc3\xa9\xe2\x82\xac\xf0\x9d\x84\x9e.vtu";
  EXPECT_EQ(drawableText(text), text);
  EXPECT_EQ(drawableText(""), "");
}

// Lone bytes, cut letters, letters that are too long, halves of pairs, past the last, controls.
TEST(DrawableText, ShowsOtherBytesAsQuestionMarks) {
  EXPECT_EQ(drawableText("a\x80z"), "a?z");
  EXPECT_EQ(drawableText("\xe2\x82"), "??");
  EXPECT_EQ(drawableText("\xc0\xaf"), "??");
  EXPECT_EQ(drawableText("\xe0\x80\xaf"), "???");
  EXPECT_EQ(drawableText("\xf0\x80\x80\xaf"), "????");
  EXPECT_EQ(drawableText("\xed\xa0\x80"), "???");
  EXPECT_EQ(drawableText("\xf4\x90\x80\x80"), "????");
  EXPECT_EQ(drawableText("\xef\xbf\xbf"), "???");  // no characters, which cairo refuses
  EXPECT_EQ(drawableText("\xef\xb7\x90"), "???");
  EXPECT_EQ(drawableText("\xf0\x9f\xbf\xbe"), "????");
  EXPECT_EQ(drawableText("\xef\xbf\xbd"), "\xef\xbf\xbd");
  EXPECT_EQ(drawableText("a\nb\x7f"), "a?b?");
}

}  // namespace
}  // namespace tetstream::test
