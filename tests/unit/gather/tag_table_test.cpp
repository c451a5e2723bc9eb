// Tags and ranks: runs, many runs that are sorted on disk, tags that are there twice.
#include "tag_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "slow_run.h"

namespace tetstream {
namespace {

// Above what is held in memory.
size_t many() {
  return test::slowRun() ? 300000 : 600000;
}

TEST(TagTable, FindsRunsAndSingleTags) {
  TagTable table("");
  int64_t rank = 0, count = 0, twice = 0;
  for (int64_t tag : std::vector<int64_t>{100, 101, 102, 7, 8, 1000000000000})
    table.add(tag, rank++);
  table.add(50, rank, 6);
  table.add(51, rank + 6, 6);
  table.add(52, rank + 12, 0);
  ASSERT_TRUE(table.finish(&twice));
  EXPECT_TRUE(table.find(102, &rank));
  EXPECT_EQ(rank, 2);
  EXPECT_TRUE(table.find(1000000000000, &rank));
  EXPECT_EQ(rank, 5);
  EXPECT_TRUE(table.find(51, &rank, &count));
  EXPECT_EQ(rank, 12);
  EXPECT_EQ(count, 6);
  EXPECT_TRUE(table.find(52, &rank, &count));
  EXPECT_EQ(count, 0);
  for (int64_t tag : {-1, 0, 6, 9, 53, 99, 103}) EXPECT_FALSE(table.find(tag, &rank)) << tag;
}

TEST(TagTable, FindsEveryTagOfManyThatComeInAnyOrder) {
  const size_t size = many();
  std::vector<int64_t> tags(size);
  for (size_t i = 0; i < size; ++i) tags[i] = 3 * static_cast<int64_t>(i);
  std::shuffle(tags.begin(), tags.end(), std::mt19937(1));
  TagTable table("");
  int64_t twice = 0, rank = 0;
  for (size_t i = 0; i < size; ++i) table.add(tags[i], static_cast<int64_t>(i));
  ASSERT_TRUE(table.finish(&twice));
  for (size_t i = 0; i < size; i += 31) {
    ASSERT_TRUE(table.find(tags[i], &rank));
    ASSERT_EQ(rank, static_cast<int64_t>(i));
    ASSERT_FALSE(table.find(tags[i] + 1, &rank));
  }
}

TEST(TagTable, TakesMoreTagsAfterItsFirstLook) {
  for (int64_t size : {int64_t{10}, int64_t{300000}}) {  // the latter above what is held in memory
    TagTable table("");
    int64_t twice = 0, rank = 0;
    for (int64_t i = 0; i < size; ++i) table.add(4 * (size - i), i);
    ASSERT_TRUE(table.finish(&twice));
    ASSERT_TRUE(table.find(4, &rank));
    for (int64_t i = 0; i < 10; ++i) table.add(4 * i + 2, size + i);
    ASSERT_TRUE(table.finish(&twice));
    for (int64_t tag : {int64_t{4}, int64_t{36}, 4 * size}) {
      ASSERT_TRUE(table.find(tag, &rank)) << tag;
      EXPECT_EQ(rank, size - tag / 4);
    }
    ASSERT_TRUE(table.find(38, &rank));
    EXPECT_EQ(rank, size + 9);
    EXPECT_FALSE(table.find(3, &rank));
    table.add(8, 0);
    EXPECT_FALSE(table.finish(&twice));
    EXPECT_EQ(twice, 8);
  }
}

TEST(TagTable, TellsATagThatIsThereTwice) {
  for (size_t runs : {size_t{10}, many()}) {
    TagTable table("");
    for (size_t i = 0; i < runs; ++i)
      table.add(2 * static_cast<int64_t>(runs - i), static_cast<int64_t>(i));
    table.add(6, 5);
    int64_t twice = 0;
    EXPECT_FALSE(table.finish(&twice));
    EXPECT_EQ(twice, 6);
  }
}

}  // namespace
}  // namespace tetstream
