// Rows by their labels: each group in one piece, in it the order in which they came.
#include "grouped_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <random>
#include <vector>

namespace tetstream {
namespace {

struct GroupedRow {
  int64_t label;
  uint64_t rank;        // among all, as they came
  uint64_t filler[13];  // makes a place and a row 128 bytes
};

GroupedRow groupedRow(int64_t label, uint64_t rank) {
  GroupedRow row = {label, rank, {}};
  std::fill_n(row.filler, 13, rank);
  return row;
}

// Adds a row of each of the labels; then each row is where a stable sort puts it.
void expectGrouped(const std::vector<int64_t>& labels) {
  std::map<int64_t, uint64_t> counts;
  for (int64_t label : labels) ++counts[label];
  GroupedRows<GroupedRow> grouped(counts, "");
  std::vector<uint64_t> places;
  for (uint64_t rank = 0; rank < labels.size(); ++rank) {
    const int64_t label = labels[static_cast<size_t>(rank)];
    places.push_back(grouped.add(label, groupedRow(label, rank)));
  }
  grouped.finish();
  ASSERT_EQ(grouped.rows().rows(), labels.size());
  GroupedRow before = groupedRow(INT64_MIN, 0);
  for (uint64_t place = 0; place < labels.size(); ++place) {
    GroupedRow row;
    std::memcpy(&row, grouped.rows().row(place), sizeof row);
    ASSERT_EQ(row.label, labels[static_cast<size_t>(row.rank)]);
    ASSERT_EQ(places[static_cast<size_t>(row.rank)], place);
    ASSERT_EQ(row.filler[12], row.rank);
    ASSERT_TRUE(before.label < row.label || (before.label == row.label && before.rank < row.rank));
    before = row;
  }
}

std::vector<int64_t> labelsOf(size_t rows, int64_t labels) {
  std::vector<int64_t> all;
  std::mt19937 random(1);
  for (size_t i = 0; i < rows; ++i)
    all.push_back(static_cast<int64_t>(random()) % labels - labels / 2);
  return all;
}

TEST(GroupedRows, FollowEachOtherByLabelAsTheyCame) {
  expectGrouped({7, -3, 7, 7, INT64_MIN, -3, INT64_MAX, 7});
  expectGrouped({1});
  expectGrouped(std::vector<int64_t>(1000, 5));
  expectGrouped(labelsOf(5000, 2));
  expectGrouped(labelsOf(5000, 1000));
}

// More than are sorted at a time.
TEST(GroupedRows, FollowEachOtherWhenTheyAreMany) {
  constexpr size_t kRows = 140000;
  static_assert(bucketsFor(kRows, sizeof(uint64_t) + sizeof(GroupedRow)) > 1);
  expectGrouped(labelsOf(kRows, 5));
}

TEST(GroupedRows, MayBeNone) {
  expectGrouped({});
  GroupedRows<GroupedRow> grouped({{1, 0}, {2, 1}, {3, 0}}, "");
  EXPECT_EQ(grouped.add(2, groupedRow(2, 0)), 0u);
  grouped.finish();
  EXPECT_EQ(grouped.rows().rows(), 1u);
}

}  // namespace
}  // namespace tetstream
