#include "base64.h"

#include <gtest/gtest.h>

#include <string>

#include "vtu_encode.h"

namespace tetstream {
namespace {

std::string decode(const std::string& text, size_t* used) {
  std::string out(text.size() / 4 * 3, '\0');
  const size_t size = decodeBase64(text.data(), text.size() / 4,
                                   reinterpret_cast<unsigned char*>(out.data()), used);
  out.resize(size);
  return out;
}

TEST(Base64, DecodesTheExamplesOfRfc4648) {
  size_t used;
  EXPECT_EQ(decode("Zm9vYmFy", &used), "foobar");
  EXPECT_EQ(decode("Zm9vYmE=", &used), "fooba");
  EXPECT_EQ(decode("Zm9vYg==", &used), "foob");
  EXPECT_EQ(used, 2u);
  EXPECT_EQ(decode("", &used), "");
}

TEST(Base64, GivesBackEveryByteValue) {
  std::string bytes;
  for (int i = 0; i < 257; ++i) bytes += static_cast<char>(i * 7);
  for (size_t size = 0; size <= bytes.size(); ++size) {
    size_t used;
    EXPECT_EQ(decode(test::encodeBase64(bytes.substr(0, size)), &used), bytes.substr(0, size));
  }
}

TEST(Base64, StopsAtPaddingAndAtWhatIsNoBase64) {
  size_t used;
  EXPECT_EQ(decode("Zm9vYg==Zm9v", &used), "foob");
  EXPECT_EQ(used, 2u);
  for (const char* bad : {"Zm9v ABC", "Zm9v\n123", "Zm9v=AAA", "Zm9vA===", "Zm9vAA=A",
                          "Zm9v\x80"
                          "AAA"}) {
    EXPECT_EQ(decode(bad, &used), "foo") << bad;
    EXPECT_EQ(used, 1u) << bad;
  }
}

}  // namespace
}  // namespace tetstream
