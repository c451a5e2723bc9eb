// cli: a JSON value written as text. Depends on text.h.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tetstream::cli {

// Appends to one text; the caller opens and closes in order, commas and indents come by themselves.
class JsonText {
 public:
  JsonText& open(char bracket);   // '{' or '['
  JsonText& close(char bracket);  // '}' or ']'
  JsonText& key(std::string_view name);
  JsonText& value(std::string_view text);                  // bytes that are no UTF-8 become U+FFFD
  JsonText& value(double number);                          // null if it is not finite
  JsonText& values(const double* numbers, int32_t count);  // an array; without numbers null
  JsonText& values(const std::vector<std::string>& texts);
  JsonText& null() { return raw("null"); }
  template <class Integer>
  requires std::is_integral_v<Integer> JsonText& value(Integer number) {
    if constexpr (std::is_same_v<Integer, bool>) return raw(number ? "true" : "false");
    return raw(std::to_string(number));
  }
  std::string take() { return std::move(text_) + "\n"; }

 private:
  JsonText& raw(std::string_view word);
  void separate();
  void newLine();
  void quote(std::string_view text);

  std::string text_;
  size_t depth_ = 0;
  bool first_ = true, after_key_ = false;
};

}  // namespace tetstream::cli
