#include "text_values.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <type_traits>

#include "text_number.h"

namespace tetstream {

template <class T>
bool parseValue(std::string_view word, T* value) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const std::from_chars_result r = std::from_chars(word.data(), end, *value);
  if (r.ec == std::errc() && r.ptr == end) return true;
  if constexpr (std::is_floating_point_v<T>) {
    if (r.ec == std::errc::result_out_of_range && r.ptr == end && isTiny(word)) {
      *value = word[0] == '-' ? -T(0) : T(0);
      return true;
    }
  }
  return false;
}

template bool parseValue(std::string_view word, float* value);
template bool parseValue(std::string_view word, double* value);
template bool parseValue(std::string_view word, int64_t* value);
template bool parseValue(std::string_view word, uint64_t* value);

// The end of the word that stands there; null: it is no value.
template <class T>
static const char* readValue(const char* at, const char* end, T* value) {
  const char* word_end = readPlain(at, value);
  if (word_end && isBlank(*word_end)) return word_end;
  word_end = std::find_if(at, end, isBlank);
  const std::string_view word(at, static_cast<size_t>(word_end - at));
  return word.size() <= kMostValueBytes && parseValue(word, value) ? word_end : nullptr;
}

template <class T>
static PieceParser::Found parseValues(const char* at, const char* end, unsigned char* out) {
  PieceParser::Found found;
  for (;; out += sizeof(T), ++found.numbers) {
    while (isBlank(*at)) ++at;
    found.is_whole = at == end;
    if (found.is_whole) return found;
    T value;
    at = readValue(at, end, &value);
    if (!at) return found;
    std::memcpy(out, &value, sizeof value);
  }
}

ValueParser::Found ValueParser::parse(const char* text, size_t size, uint64_t* out) const {
  return withTextType(type_, [&](auto t) {
    return parseValues<decltype(t)>(text, text + size, reinterpret_cast<unsigned char*>(out));
  });
}

}  // namespace tetstream
