// Ids are told from labels, however many of these there are and in whatever order they come.
#include "id_census.h"

#include <gtest/gtest.h>

#include <functional>

#include "slow_run.h"

namespace tetstream::test {
namespace {

// Of the labels of rows 0, 1, ...
bool areIds(uint64_t rows, const std::function<int64_t(uint64_t)>& label,
            uint32_t fewest = kFewestCellsOfALabel) {
  IdCensus census(rows, fewest);
  for (uint64_t row = 0; row < rows; ++row) {
    const int64_t at = label(row);
    census.add(&at, 1);
  }
  return census.areIds();
}

auto inTurn(uint64_t labels) {
  return [labels](uint64_t row) { return static_cast<int64_t>(row % labels); };
}

auto inRuns(uint64_t each) {
  return [each](uint64_t row) { return static_cast<int64_t>(row / each) - 3; };
}

uint64_t many() {
  return slowRun() ? 60000 : 1000000;
}

TEST(IdCensus, ThousandsOfLabelsAreNoIds) {
  for (uint64_t each : {10, 160}) {
    EXPECT_FALSE(areIds(many(), inRuns(each))) << each;
    EXPECT_FALSE(areIds(many(), inTurn(many() / each))) << each;
  }
}

TEST(IdCensus, CellsCutFromOneShareItsId) {
  for (uint64_t rows : {uint64_t{600}, uint64_t{5000}, many()})
    for (uint64_t each : {1, 2, 6}) {
      EXPECT_TRUE(areIds(rows, inRuns(each))) << rows << " " << each;
      EXPECT_TRUE(areIds(rows, inTurn(rows / each))) << rows << " " << each;
    }
}

TEST(IdCensus, FacesOfALabelMayBeTwo) {
  EXPECT_TRUE(areIds(many(), inRuns(1), kFewestFacesOfALabel));
  EXPECT_FALSE(areIds(many(), inRuns(2), kFewestFacesOfALabel));
}

TEST(IdCensus, AFewLabelsAreNeverIds) {
  EXPECT_FALSE(areIds(16, inRuns(1)));
  EXPECT_TRUE(areIds(17, inRuns(1)));
  EXPECT_FALSE(areIds(0, inRuns(1)));
  EXPECT_FALSE(areIds(many(), [](uint64_t) { return 7; }));
}

// Small inclusions in a matrix are labels as long as that is the larger part.
TEST(IdCensus, GoByMostRows) {
  const auto inclusions = [](int64_t percent) {
    return [percent](uint64_t row) {
      return static_cast<int64_t>(row % 100) < percent ? static_cast<int64_t>(row / 4) + 1 : 0;
    };
  };
  EXPECT_FALSE(areIds(many(), inclusions(40)));
  EXPECT_TRUE(areIds(many(), inclusions(60)));
}

TEST(IdCensus, RowsOfSeveralComponentsAreOneLabel) {
  IdCensus pairs(10000), few(10000);
  for (int64_t row = 0; row < 10000; ++row) {
    const int64_t pair[2] = {row % 100, row / 100}, again[2] = {row % 20, row % 30};
    pairs.add(pair, 2);
    few.add(again, 2);
  }
  EXPECT_TRUE(pairs.areIds());
  EXPECT_FALSE(few.areIds());
}

}  // namespace
}  // namespace tetstream::test
