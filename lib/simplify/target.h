// simplify: when a run may stop. Depends on state.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "options.h"

namespace tetstream {

constexpr double kUsualRatio = 0.1;  // where there is no target

// Reductions, cells in over cells out.
constexpr int64_t kMildReduction = 12, kStrongReduction = 4;

// 0: not given. The first that is reached ends the run.
struct Target {
  double ratio = 0, error = 0;
  int64_t cells = 0;
  bool countsCells() const { return ratio > 0 || cells > 0; }
  // Cells out when `read` have come in: never more than asked for, but one where there are any.
  int64_t cellsOf(int64_t read) const {
    return std::max({share(read), std::min(cells, read), std::min<int64_t>(read, 1)});
  }
  // With so many times the cells, if more.
  Target times(double factor) const {
    const double more = std::min(factor * static_cast<double>(cells), 0x1p60);
    return {factor * ratio, error, factor > 1 ? static_cast<int64_t>(more) : cells};
  }

 private:
  // Of 0.29 times 100 the product is 28.999999999999996: it is below a whole number by half a unit
  // in the last place for the ratio and half a one for itself.
  int64_t share(int64_t read) const {
    constexpr double kRounding = 2 * std::numeric_limits<double>::epsilon();
    return static_cast<int64_t>(ratio * static_cast<double>(read) * (1 + kRounding));
  }
};

// That of the options, or the usual one. Throws for what the stream or the mode cannot have.
Target targetOf(const Schema& schema, const SimplifyOptions& options);

// Than `times` as many as the others: of any numbers that a stream may announce.
inline bool isMoreThan(int64_t cells, int64_t times, int64_t others) {
  return others <= std::numeric_limits<int64_t>::max() / times && cells > times * others;
}

}  // namespace tetstream
