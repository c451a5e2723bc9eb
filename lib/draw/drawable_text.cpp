#include "drawable_text.h"

#include <cstdint>

namespace tetstream {

// The bytes of UTF-8 that begin at `at`: 0 if there are none such, or cairo refuses them.
static size_t characterAt(const std::string& text, size_t at) {
  const auto byte = [&](size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(at);
  if (first < 0x80) return first >= 0x20 && first != 0x7f;
  const size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  uint32_t code = first & (0x7fu >> size);
  for (size_t i = 1; i < size; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) return 0;
    code = code << 6 | (byte(at + i) & 0x3f);
  }
  const bool too_long = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool unpaired = code >= 0xd800 && code < 0xe000;
  const bool no_character = (code & 0xfffe) == 0xfffe || (code >= 0xfdd0 && code < 0xfdf0);
  return too_long || unpaired || no_character || code > 0x10ffff ? 0 : size;
}

std::string drawableText(const std::string& text) {
  std::string out;
  for (size_t at = 0; at < text.size();) {
    const size_t size = characterAt(text, at);
    out += size ? text.substr(at, size) : "?";
    at += size ? size : 1;
  }
  return out;
}

}  // namespace tetstream
