// simplify: how many cells a window may keep. Depends on options.h.
#pragma once

#include <algorithm>
#include <cstdint>

#include "select.h"

namespace tetstream {

// What the loop knows when it sets a goal.
struct Ledger {
  int64_t read = 0;     // cells read so far
  int64_t written = 0;  // cells written so far
  int64_t front = 0;    // cells of the window that touch a vertex not yet final
};

// The paper's: the same ratio all along the stream. Cells of the front cannot be simplified yet and
// count in full; what an earlier window missed or saved is carried over.
class UniformRatio {
 public:
  UniformRatio(double ratio, int64_t cells) : ratio_(ratio), cells_(cells) {}

  // Cells out when `read` have come in: never more than asked for, but one where there are any.
  int64_t target(int64_t read) const {
    if (cells_ > 0) return std::min(cells_, read);
    return std::max(static_cast<int64_t>(ratio_ * static_cast<double>(read)),
                    std::min<int64_t>(read, 1));
  }
  Goal goalOf(const Ledger& ledger) const {
    const double done = ratio_ * static_cast<double>(ledger.read - ledger.front);
    return {static_cast<int64_t>(done) + ledger.front - ledger.written, 0, false};
  }
  // At the end: not below the target by more than 0.2 % and 10 cells.
  Goal lastGoal(const Ledger& ledger) const {
    const int64_t all = target(ledger.read), slack = std::max<int64_t>(all / 500, 10);
    return {all - ledger.written, all - slack - ledger.written, true};
  }

 private:
  double ratio_;
  int64_t cells_;
};

}  // namespace tetstream
