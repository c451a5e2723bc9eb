#include "text_number.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <type_traits>

#include "plain_number.h"

namespace tetstream {

// std::from_chars takes no '+', which other writers print.
static std::string_view withoutPlus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

template <class T>
static std::errc parseAs(std::string_view word, T* out) {
  const char* end = word.data() + word.size();
  const std::from_chars_result r = std::from_chars(word.data(), end, *out);
  return r.ptr == end && !word.empty() ? r.ec : std::errc::invalid_argument;
}

// Its size is that of 0.d * 10^(places + exponent), d the first digit that is not 0.
bool isTiny(std::string_view word) {
  const size_t e = word.find_first_of("eE");
  int64_t places = 0, exponent = 0;
  bool point = false, found = false;
  for (char c : word.substr(0, e)) {
    if (c == '.') point = true;
    if (c < '0' || c > '9') continue;
    found = found || c != '0';
    if (found && !point) ++places;
    if (!found && point) --places;
  }
  if (e == std::string_view::npos) return places < 0;
  const std::string_view digits = withoutPlus(word.substr(e + 1));
  if (parseAs(digits, &exponent) == std::errc::result_out_of_range) return digits[0] == '-';
  return places < -std::max(exponent, -INT64_MAX);
}

static bool parseFloat64(std::string_view word, double* out) {
  const std::errc error = parseAs(word, out);
  if (error != std::errc::result_out_of_range) return error == std::errc();
  *out = isTiny(word) ? 0 : __builtin_huge_val();
  if (word[0] == '-') *out = -*out;
  return true;
}

static bool parseFloat32(std::string_view word, float* out) {
  const std::errc error = parseAs(word, out);
  if (error != std::errc::result_out_of_range) return error == std::errc();
  double wide = 0;
  if (!parseFloat64(word, &wide)) return false;
  *out = static_cast<float>(wide);
  return true;
}

template <class T>
static bool parseInto(std::string_view word, void* out) {
  T value = 0;
  if (parseAs(word, &value) != std::errc()) return false;
  std::memcpy(out, &value, sizeof value);
  return true;
}

bool parseNumber(std::string_view word, ScalarType type, void* out) {
  word = withoutPlus(word);
  switch (type) {
    case ScalarType::kFloat32: {
      float value = 0;
      if (!parseFloat32(word, &value)) return false;
      std::memcpy(out, &value, sizeof value);
      return true;
    }
    case ScalarType::kFloat64: {
      double value = 0;
      if (!parseFloat64(word, &value)) return false;
      std::memcpy(out, &value, sizeof value);
      return true;
    }
    case ScalarType::kInt32:
      return parseInto<int32_t>(word, out);
    case ScalarType::kInt64:
      return parseInto<int64_t>(word, out);
  }
  return false;
}

bool parseInteger(std::string_view word, int64_t* out) {
  return parseAs(withoutPlus(word), out) == std::errc();
}

static bool parseWord(std::string_view word, int64_t* out) {
  return parseInteger(word, out);
}

static bool parseWord(std::string_view word, double* out) {
  if (parseNumber(word, ScalarType::kFloat64, out)) return true;
  std::string usual(word);
  std::replace_if(
      usual.begin(), usual.end(), [](char c) { return c == 'D' || c == 'd'; }, 'e');
  return parseNumber(usual, ScalarType::kFloat64, out);
}

template <class T>
static const char* readWordAs(const char* begin, const char* end, T* value) {
  const std::from_chars_result r = std::from_chars(begin, end, *value);
  if (r.ec == std::errc() && (r.ptr == end || isBlank(*r.ptr))) return r.ptr;
  const char* word_end = std::find_if(begin, end, isBlank);
  return parseWord({begin, word_end}, value) ? word_end : nullptr;
}

const char* readWord(const char* begin, const char* end, int64_t* value) {
  return readWordAs(begin, end, value);
}

const char* readWord(const char* begin, const char* end, double* value) {
  return readWordAs(begin, end, value);
}

std::optional<double> realIn(std::string_view text) {
  const char* begin = std::find_if_not(text.begin(), text.end(), isBlank);
  const char* const end = text.end();
  double value;
  const char* const word_end = begin == end ? nullptr : readWord(begin, end, &value);
  if (!word_end || !std::all_of(word_end, end, isBlank)) return {};
  return value;
}

// note: general notation, for plain to_chars prints large floats as integers of more digits than
// the type holds, and readers would take them for doubles.
template <class T>
static void printAs(const void* value, std::string& out) {
  T number;
  std::memcpy(&number, value, sizeof number);
  char text[32];  // the longest is a double's 24 characters
  if constexpr (std::is_floating_point_v<T>)
    out.append(text,
               std::to_chars(text, text + sizeof text, number, std::chars_format::general).ptr);
  else
    out.append(text, std::to_chars(text, text + sizeof text, number).ptr);
}

void printNumber(const void* value, ScalarType type, std::string& out) {
  switch (type) {
    case ScalarType::kFloat32:
      return printAs<float>(value, out);
    case ScalarType::kFloat64:
      return printAs<double>(value, out);
    case ScalarType::kInt32:
      return printAs<int32_t>(value, out);
    case ScalarType::kInt64:
      return printAs<int64_t>(value, out);
  }
}

void printInteger(int64_t value, std::string& out) {
  printNumber(&value, ScalarType::kInt64, out);
}

std::string quoted(std::string_view word) {
  std::string text = "\"";
  for (char c : word.substr(0, 32)) text += c >= 32 && c < 127 ? c : '?';
  return text + (word.size() > 32 ? "...\"" : "\"");
}

}  // namespace tetstream
