// simplify/state: what is known of the whole stream before it is simplified. Depends on balance.h.
#pragma once

#include <cstdint>
#include <vector>

#include "balance.h"

namespace tetstream {

// Cells left at a bound b: proportional to b^-kDecay, in space and for a field that linear
// interpolation follows (squared error times volume ~ n^(-7/3) for n cells).
constexpr double kDecay = 3.0 / 7;

// Windows of bounded memory that come to know of a stream of so few what nobody tells them.
constexpr int64_t kFewWindows = 4;
// A window that is little more than its front has too few cells to simplify for a share.
constexpr double kLeastFronts = 1.5;

// Of a run with the whole mesh in its window, or of a sample: how the cells that are left are
// spread over the stream; and of the whole mesh the error at which the target is reached. What a
// sample says of that may be wrong by orders of magnitude, as its cuts are held.
struct Pilot {
  double bound = 0;           // in the report's unit; 0: not known
  std::vector<double> share;  // share[k]: of all cells out, those of the first k / (size - 1) in
  Balance balance = {};       // of what was looked at

  bool known() const { return !share.empty(); }
  // As far as it can tell, all parts of the stream should keep the same.
  bool isEven() const { return share.size() == 2; }
  // The share of the cells out that the first `part` (0 to 1) of the cells in leaves.
  double shareOf(double part) const {
    const double place = part * static_cast<double>(share.size() - 1);
    const auto k = static_cast<size_t>(place);
    if (k + 1 >= share.size()) return 1;
    return share[k] + (place - static_cast<double>(k)) * (share[k + 1] - share[k]);
  }
};

}  // namespace tetstream
