// file: words of text as values of an array's type. Depends on piece_parser.h, values.h, file/text.
#pragma once

#include <string_view>
#include <type_traits>
#include <utility>

#include "piece_parser.h"
#include "values.h"

namespace tetstream {

// The longest word of an array.
constexpr size_t kMostValueBytes = 512;

// T as in withTextType. A plus sign may stand before the number. Too small for T is 0;
// too large is an error.
template <class T>
bool parseValue(std::string_view word, T* value);

// Whether it is a value of an array of Out; of floats it is rounded to one.
template <class Out, class T>
bool holds(T value) {
  if constexpr (std::is_integral_v<T> && std::is_integral_v<Out>)
    return std::in_range<Out>(value);
  else
    return true;
}

// note: so that numbers of all types are read alike.
inline const char* readPlain(const char* at, uint64_t* value) {
  int64_t found;
  const char* end = readPlain(at, &found);
  if (end) *value = static_cast<uint64_t>(found);
  return end;
}

// Calls visit with a T, the type in which text of such values is read: float, double, uint64_t, or
// int64_t for all other integers.
template <class Visit>
auto withTextType(ValueType type, Visit visit) {
  if (type == ValueType::kFloat32) return visit(float{});
  if (type == ValueType::kFloat64) return visit(double{});
  if (type == ValueType::kUInt64) return visit(uint64_t{});
  return visit(int64_t{});
}

// Values one behind the other, each in its T.
class ValueParser final : public PieceParser {
 public:
  explicit ValueParser(ValueType type) : type_(type) {}
  Found parse(const char* text, size_t size, uint64_t* out) const override;
  size_t roomFor(size_t bytes) const override { return bytes / 2 + 1; }
  bool isCutAtBlanks() const override { return true; }

 private:
  ValueType type_;
};

}  // namespace tetstream
