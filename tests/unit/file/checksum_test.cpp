// CRC-32: the numbers that zlib gives, whichever library makes them.
#include "checksum.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace tetstream {
namespace {

TEST(Checksum, IsThatOfZlib) {
  EXPECT_EQ(checksum(0, "123456789", 9), 0xcbf43926u);  // the check value of CRC-32
  EXPECT_EQ(checksum(0, nullptr, 0), 0u);
}

TEST(Checksum, GoesOnFromWhatCameBefore) {
  std::vector<unsigned char> bytes;
  for (uint32_t i = 0; i < 5000; ++i) bytes.push_back(static_cast<unsigned char>(i * i >> 3));
  const uint32_t all = checksum(0, bytes.data(), bytes.size());
  for (size_t first : {0u, 1u, 63u, 4096u, 5000u})
    EXPECT_EQ(
        checksum(checksum(0, bytes.data(), first), bytes.data() + first, bytes.size() - first), all)
        << first;
}

}  // namespace
}  // namespace tetstream
