#include "json.h"

#include <cmath>

#include "text.h"

namespace tetstream::cli {

void JsonText::newLine() {
  text_ += '\n';
  text_.append(2 * depth_, ' ');
}

void JsonText::separate() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (!first_) text_ += ',';
  if (depth_ > 0) newLine();
  first_ = false;
}

JsonText& JsonText::values(const double* numbers, int32_t count) {
  if (!numbers) return null();
  open('[');
  for (int32_t i = 0; i < count; ++i) value(numbers[i]);
  return close(']');
}

JsonText& JsonText::values(const std::vector<std::string>& texts) {
  open('[');
  for (const std::string& text : texts) value(std::string_view(text));
  return close(']');
}

JsonText& JsonText::raw(std::string_view word) {
  separate();
  text_ += word;
  return *this;
}

JsonText& JsonText::open(char bracket) {
  separate();
  text_ += bracket;
  ++depth_;
  first_ = true;
  return *this;
}

JsonText& JsonText::close(char bracket) {
  --depth_;
  if (!first_) newLine();
  text_ += bracket;
  first_ = false;
  return *this;
}

JsonText& JsonText::key(std::string_view name) {
  separate();
  quote(name);
  text_ += ": ";
  after_key_ = true;
  return *this;
}

JsonText& JsonText::value(std::string_view text) {
  separate();
  quote(text);
  return *this;
}

JsonText& JsonText::value(double number) {
  return std::isfinite(number) ? raw(exactText(number)) : null();
}

// The length of the UTF-8 sequence that `text` begins with, by the table of well-formed sequences
// of the Unicode standard (no overlong forms, no surrogates); 0 if there is none.
static size_t sequenceLength(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return 0;
  const unsigned char low = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
  const unsigned char high = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
  if (byte(1) < low || byte(1) > high) return 0;
  for (size_t i = 2; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  return length;
}

void JsonText::quote(std::string_view text) {
  text_ += '"';
  while (!text.empty()) {
    const size_t length = sequenceLength(text);
    const char c = text.front();
    if (length == 0)
      text_ += "\\ufffd";
    else if (c == '"' || c == '\\')
      (text_ += '\\') += c;
    else if (static_cast<unsigned char>(c) < ' ' || c == 0x7f)
      text_ += textOf("\\u%04x", static_cast<unsigned>(c));
    else
      text_ += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  text_ += '"';
}

}  // namespace tetstream::cli
