#include "sv_check.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace tetstream::test {
namespace {

// Against a plain list of what is active.
TEST(SvActive, AgreesWithAListOfActiveVertices) {
  std::mt19937 random(4);
  SvActive active;
  std::vector<bool> expected;
  std::vector<int64_t> list;
  for (int step = 0; step < 60000; ++step) {
    if (list.size() < 3 || random() % 100 < (step < 30000 ? 55u : 49u)) {
      list.push_back(active.introduced());
      expected.push_back(true);
      active.introduce();
    } else {
      const size_t at = random() % 8 ? 0 : random() % list.size();
      expected[static_cast<size_t>(list[at])] = false;
      active.finalize(list[at]);
      list.erase(list.begin() + static_cast<std::ptrdiff_t>(at));
    }
    if (step % 5000) continue;
    for (size_t i = 0; i < expected.size(); ++i)
      ASSERT_EQ(active.contains(static_cast<int64_t>(i)), expected[i]) << i;
  }
}

TEST(SvActive, ForgetsWholePagesAndGoesOn) {
  SvActive active;
  for (int64_t i = 0; i < 3 * 4096; ++i) {
    active.introduce();
    active.finalize(i);
    ASSERT_FALSE(active.contains(i));
  }
  active.introduce();
  EXPECT_TRUE(active.contains(3 * 4096));
  EXPECT_FALSE(active.contains(3 * 4096 + 1));
}

}  // namespace
}  // namespace tetstream::test
