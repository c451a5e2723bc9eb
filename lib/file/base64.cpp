#include "base64.h"

#include <array>
#include <cstdint>

namespace tetstream {

namespace {

constexpr uint32_t kBad = 0x80;  // above every value of a character

constexpr std::array<uint8_t, 256> makeValues() {
  std::array<uint8_t, 256> values{};
  for (uint8_t& v : values) v = kBad;
  const char* alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (uint8_t i = 0; i < 64; ++i) values[static_cast<uint8_t>(alphabet[i])] = i;
  return values;
}

constexpr std::array<uint8_t, 256> kValues = makeValues();

uint32_t valueOf(char c) {
  return kValues[static_cast<unsigned char>(c)];
}

// One or two bytes from a group that ends in "==" or "=", 0 if it is none.
size_t decodePadded(const char* text, unsigned char* out) {
  const uint32_t a = valueOf(text[0]), b = valueOf(text[1]);
  if ((a | b) & kBad || text[3] != '=') return 0;
  out[0] = static_cast<unsigned char>(a << 2 | b >> 4);
  if (text[2] == '=') return 1;
  const uint32_t c = valueOf(text[2]);
  if (c & kBad) return 0;
  out[1] = static_cast<unsigned char>(b << 4 | c >> 2);
  return 2;
}

}  // namespace

size_t decodeBase64(const char* text, size_t groups, unsigned char* out, size_t* used) {
  unsigned char* const begin = out;
  for (size_t i = 0; i < groups; ++i, text += 4, out += 3) {
    const uint32_t a = valueOf(text[0]), b = valueOf(text[1]);
    const uint32_t c = valueOf(text[2]), d = valueOf(text[3]);
    if ((a | b | c | d) & kBad) {
      const size_t last = decodePadded(text, out);
      *used = i + (last > 0);
      return static_cast<size_t>(out - begin) + last;
    }
    out[0] = static_cast<unsigned char>(a << 2 | b >> 4);
    out[1] = static_cast<unsigned char>(b << 4 | c >> 2);
    out[2] = static_cast<unsigned char>(c << 6 | d);
  }
  *used = groups;
  return static_cast<size_t>(out - begin);
}

}  // namespace tetstream
