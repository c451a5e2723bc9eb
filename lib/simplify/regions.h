// simplify: which integer cell arrays label regions. Depends on core.h.
#pragma once

#include "core.h"

namespace tetstream {

// Decides once, on the first window's cells: "none": none; a name: that array; "auto": every
// integer array, but for those whose values are nearly all different, which are ids. Says in the
// report what was taken. Throws kBadArgument for a name that is no integer cell array.
template <class S>
class Regions {
 public:
  explicit Regions(Core<S>& core);
  void decide();  // with the first cells in the window
  bool none() const { return picks_.empty(); }
  // Whether two cells lie in different regions.
  bool differ(uint32_t a, uint32_t b) const;

 private:
  bool looksLikeIds(int offset, int components) const;

  Core<S>& core_;
  bool decided_ = false;
  std::vector<int> columns_;  // candidates, by column
  std::vector<int> picks_;    // components that count, by place among the cell picks
};

}  // namespace tetstream
