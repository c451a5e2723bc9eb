// What is said of regions whose volumes change.
#include "label_volumes.h"

#include <gtest/gtest.h>

namespace tetstream::test {
namespace {

// Of each cell an id, and two numbers that label it.
const int64_t kRows[] = {90, 1, 5, 91, 1, 6, 92, 2, 5, 93, 1, 5};
const int kColumns[] = {1, 2};

TEST(LabelVolumes, AreToldOfThoseThatChangeTheMost) {
  const CellLabels labels = {kRows, 3, kColumns, 2, nullptr};
  LabelVolumes volumes;
  EXPECT_EQ(volumes.changesInWords(), "");
  for (uint32_t c : {0u, 1u, 2u, 3u}) volumes.add(labels, c, 10, LabelVolumes::kInput);
  ASSERT_NE(volumes.find(labels, kRows + 9), nullptr);
  EXPECT_EQ(volumes.find(labels, kRows + 9)->of[LabelVolumes::kInput], 20);  // of 1/5
  EXPECT_EQ(volumes.find(labels, kRows + 1), nullptr);
  for (uint32_t c : {3u, 0u}) volumes.add(labels, c, 10.09, LabelVolumes::kOutput);  // of 1/5
  volumes.add(labels, 1, 5, LabelVolumes::kOutput);
  volumes.add(labels, 2, 10.2, LabelVolumes::kOutput);
  EXPECT_EQ(volumes.changesInWords(),
            "2 of 3 regions changed their volume by more than 1 %: 1/6 by -50 %, 2/5 by +2 %");
}

TEST(LabelVolumes, AreNotAllNamed) {
  std::vector<int64_t> rows;
  for (int64_t c = 0; c < 9; ++c) rows.push_back(c % 5);
  const int column = 0;
  const CellLabels labels = {rows.data(), 1, &column, 1, nullptr};
  LabelVolumes volumes;
  for (uint32_t c = 0; c < 5; ++c) {
    volumes.add(labels, c, 1, LabelVolumes::kInput);
    volumes.add(labels, c, 2 + c, LabelVolumes::kOutput);
  }
  EXPECT_EQ(volumes.changesInWords(),
            "5 of 5 regions changed their volume by more than 1 %: 4 by +500 %, 3 by +400 %, "
            "2 by +300 %, ...");
}

TEST(LabelVolumes, AreNotKeptOfAnyNumber) {
  constexpr int64_t kRegions = 10001;
  std::vector<int64_t> rows;
  for (int64_t c = 0; c < kRegions; ++c) rows.push_back(c);
  const int column = 0;
  const CellLabels labels = {rows.data(), 1, &column, 1, nullptr};
  LabelVolumes volumes;
  for (uint32_t c = 0; c < kRegions; ++c) {
    volumes.add(labels, c, 1, LabelVolumes::kInput);
    volumes.add(labels, c, c == 3 || c == kRegions - 1 ? 2 : 1, LabelVolumes::kOutput);
  }
  EXPECT_EQ(volumes.changesInWords(),
            "1 of the first 10000 regions changed their volume by more than 1 %: 3 by +100 %");
}

}  // namespace
}  // namespace tetstream::test
