// Boxes told in words, and what lies in them.
#include "part_box.h"

#include <gtest/gtest.h>
#include <limits>

#include "status.h"

namespace tetstream::test {
namespace {

constexpr double kOpen = std::numeric_limits<double>::infinity();

void expectRange(const Box& box, int axis, double low, double high) {
  EXPECT_EQ(box.low[axis], low);
  EXPECT_EQ(box.high[axis], high);
}

TEST(PartBox, HasThreeRangesWithOpenEnds) {
  const Box box = partBoxOf("0.25:1.5,:-2e3,7:");
  expectRange(box, 0, 0.25, 1.5);
  expectRange(box, 1, -kOpen, -2000);
  expectRange(box, 2, 7, kOpen);
}

TEST(PartBox, OfNoWordsIsTheWholeOfSpace) {
  for (const char* text : {"", ":,:,:"})
    for (int axis = 0; axis < 3; ++axis) expectRange(partBoxOf(text), axis, -kOpen, kOpen);
  const double far[3] = {-1e300, 0, 1e300};
  EXPECT_TRUE(isWithin(partBoxOf(""), far));
}

TEST(PartBox, RefusesOtherWordsAndQuotesThem) {
  for (const char* text :
       {"0:1", "0:1,0:1", "0:1,0:1,0:1,0:1", "0,1,2", "a:1,:,:", "0:1x,:,:", "1:0,:,:", "1:1,:,:",
        "nan:1,:,:", "0:inf,:,:", " 0:1,:,:", "0:1,:,: ", "0:1:2,:,:", ",,", "none"})
    try {
      partBoxOf(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::kBadArgument);
      EXPECT_NE(error.text().find('"' + std::string(text) + '"'), std::string::npos);
    }
}

TEST(PartBox, HasItsLowSidesAlone) {
  const Box left = partBoxOf("0:1,0:1,0:1"), right = partBoxOf("1:2,0:1,0:1");
  const double between[3] = {1, 0.5, 0}, corner[3] = {0, 0, 0}, above[3] = {0.5, 0.5, 1};
  EXPECT_FALSE(isWithin(left, between));
  EXPECT_TRUE(isWithin(right, between));
  EXPECT_TRUE(isWithin(left, corner));
  EXPECT_FALSE(isWithin(left, above));
}

}  // namespace
}  // namespace tetstream::test
