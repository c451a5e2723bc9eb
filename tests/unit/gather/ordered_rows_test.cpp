// Rows by their places, in whatever order they came.
#include "ordered_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

#include "slow_run.h"

namespace tetstream {
namespace {

// Of the row of a place.
std::vector<unsigned char> orderedRow(uint64_t place, size_t bytes) {
  std::vector<unsigned char> row(bytes);
  std::minstd_rand random(static_cast<uint32_t>(place) + 1);
  for (unsigned char& byte : row) byte = static_cast<unsigned char>(random());
  return row;
}

void expectOrdered(const std::vector<uint64_t>& places, size_t bytes) {
  OrderedRows rows(places.size(), bytes, "");
  for (const uint64_t place : places) rows.put(place, orderedRow(place, bytes).data());
  rows.finish();
  for (uint64_t place = 0; place < places.size(); ++place)
    ASSERT_EQ(std::memcmp(rows.row(place), orderedRow(place, bytes).data(), bytes), 0) << place;
}

std::vector<uint64_t> shuffledPlaces(size_t count) {
  std::vector<uint64_t> places(count);
  std::iota(places.begin(), places.end(), uint64_t{0});
  std::shuffle(places.begin(), places.end(), std::mt19937(1));
  return places;
}

TEST(OrderedRows, OfAnyWidthAreReadInOrder) {
  for (const size_t bytes : {1, 4, 8, 12, 24, 32, 72})
    for (const size_t count : {0, 1, 2, 1000}) expectOrdered(shuffledPlaces(count), bytes);
}

// More than one bucket of them.
TEST(OrderedRows, ThatAreManyAreSortedInParts) {
  const size_t rows = test::slowRun() ? 120000 : 200000;
  ASSERT_GT(bucketsFor(rows * 9, 16), 1u);
  expectOrdered(shuffledPlaces(rows), 72);
}

}  // namespace
}  // namespace tetstream
