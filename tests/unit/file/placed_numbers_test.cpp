// Integers of rows that lie in a file: one that is not 0 is found.
#include "placed_numbers.h"

#include <gtest/gtest.h>

namespace tetstream {
namespace {

TEST(PlacedNumbers, FindsAnIntegerThatIsNotZeroWhereverItIs) {
  constexpr size_t kRows = 100000, kRowBytes = 20;
  std::vector<unsigned char> bytes(kRows * kRowBytes + 4, 0);
  const Tasks three(3);
  const RowsPlace place = {openMemory(bytes.data(), bytes.size(), "bytes"), 4, kRows, kRowBytes,
                           false};
  for (const Tasks* tasks : {static_cast<const Tasks*>(nullptr), &three})
    for (size_t width : {size_t{4}, size_t{8}}) {
      const NumbersOfRow integer = {12, 1, width, false, false};
      EXPECT_FALSE(anyNonZero(place, integer, tasks));
      for (size_t row : {size_t{0}, size_t{16383}, size_t{16384}, size_t{44444}, kRows - 1}) {
        unsigned char& byte = bytes[4 + row * kRowBytes + 12 + width - 1];
        byte = 0x80;
        EXPECT_TRUE(anyNonZero(place, integer, tasks)) << row;
        byte = 0;
        bytes[4 + row * kRowBytes + 11] = 1;  // beside it
        EXPECT_FALSE(anyNonZero(place, integer, tasks)) << row;
        bytes[4 + row * kRowBytes + 11] = 0;
      }
    }
}

}  // namespace
}  // namespace tetstream
