#include "lone_values.h"

#include <algorithm>
#include <cmath>

#include "status.h"

namespace tetstream {

// Of the range of a field, what all values but one have: next to nothing is seen of it then. Salt
// beside -9999 has less, temperatures in kelvin have, too.
constexpr double kClose = 0.02;

std::string LoneValues::inWords(const std::vector<double>& ranges) const {
  std::string text;
  for (size_t first = 0, end; first < ends_.size(); first = end) {
    const int field = plan_.measured_column[first];
    double square = 0, square_of_all = 0, widest = 0, lone = 0;
    for (end = first; end < ends_.size() && plan_.measured_column[end] == field; ++end) {
      const double share = ends_[end].range() / ranges[3 + end], all = ends_[end].width();
      square += share * share;
      square_of_all += all / ranges[3 + end] * (all / ranges[3 + end]);
      if (all > widest) lone = ends_[end].loneValue();
      widest = std::max(widest, all);
    }
    // A part of a mesh may have little of the range that is told of the whole.
    if (!(square > 0 && square <= kClose * kClose && square_of_all > kClose * kClose)) continue;
    text += textOf("%s%s: all values but %g lie within %.2g %% of its range, by which errors count",
                   text.empty() ? "" : "; ",
                   plan_.schema.fields[static_cast<size_t>(field)].name.c_str(), lone,
                   100 * std::sqrt(square));
  }
  return text;
}

}  // namespace tetstream
