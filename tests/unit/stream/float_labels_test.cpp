// Labels that are floats.
#include "float_labels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "thrown_by.h"

namespace tetstream::test {
namespace {

const Column kSingle = {"part", 1, ScalarType::kFloat32};
const Column kPairs = {"pairs", 2, ScalarType::kFloat64};

TEST(FloatLabels, AreReadAsIntegers) {
  const float singles[] = {3, -2, 0, -0.0f, 16777216};
  int64_t out[4];
  readFloatLabels(kSingle, singles, 1, 4, 0, out);
  EXPECT_EQ(std::vector<int64_t>(out, out + 4), (std::vector<int64_t>{-2, 0, 0, 16777216}));
  const double pairs[] = {1, 2, 9007199254740991, -9007199254740991};
  readFloatLabels(kPairs, pairs, 0, 2, 0, out);
  EXPECT_EQ(std::vector<int64_t>(out, out + 4),
            (std::vector<int64_t>{1, 2, 9007199254740991, -9007199254740991}));
}

TEST(FloatLabels, OfNoIntegersAreErrorsThatNameTheCell) {
  int64_t out[4];
  for (const double wrong :
       {0.5, 9007199254740992.0, -1e300, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const double pairs[] = {1, 2, 3, wrong};
    const auto [status, text] = thrownBy([&] { readFloatLabels(kPairs, pairs, 0, 2, 40, out); });
    EXPECT_EQ(status, Status::kBadData) << wrong;
    EXPECT_NE(text.find("cell 41 has "), std::string::npos) << text;
    EXPECT_NE(text.find("\"pairs\""), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace tetstream::test
