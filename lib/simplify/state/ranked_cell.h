// simplify/state: a cell among others in order of their errors. Depends on nothing.
#pragma once

#include <cstdint>

namespace tetstream {

// The largest error first.
struct RankedCell {
  float error;
  uint32_t cell;
  bool operator<(const RankedCell& o) const {
    return error != o.error ? error > o.error : cell < o.cell;
  }
};

}  // namespace tetstream
