#include "part_box.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "status.h"

namespace tetstream {

[[noreturn]] static void refuse(const std::string& text) {
  fail(
      Status::kBadArgument,
      "a box is a range of x, of y and of z, low end first, as 0.4:0.6,0:1,: whose ends may be left"
      " out, not \"%s\"",
      text.c_str());
}

// Up to `stop`, which is passed.
static double takeEnd(const std::string& text, const char*& at, const char* stop, double open) {
  double value = open;
  if (at != stop) {
    const auto [end, error] = std::from_chars(at, stop, value);
    if (error != std::errc() || end != stop || !std::isfinite(value)) refuse(text);
  }
  at = stop + 1;
  return value;
}

Box partBoxOf(const std::string& text) {
  constexpr double kOpen = std::numeric_limits<double>::infinity();
  Box box;
  std::fill_n(box.low, 3, -kOpen);
  std::fill_n(box.high, 3, kOpen);
  if (text.empty()) return box;
  const char *at = text.data(), *end = at + text.size();
  for (int k = 0; k < 3; ++k) {
    const char* const comma = k < 2 ? std::find(at, end, ',') : end;
    const char* const colon = std::find(at, comma, ':');
    if (colon == comma || (k < 2 && comma == end)) refuse(text);
    box.low[k] = takeEnd(text, at, colon, -kOpen);
    box.high[k] = takeEnd(text, at, comma, kOpen);
    if (!(box.low[k] < box.high[k])) refuse(text);
  }
  return box;
}

}  // namespace tetstream
