// simplify/intake: which integer cell arrays label regions. Depends on core.h.
#pragma once

#include "core.h"
#include "scattered.h"

namespace tetstream {

// Decides once, on the first window's cells, which picks of a cell are its labels: "none": none; a
// name: that array; "auto": every integer array, but for those whose labels have few cells each,
// which are ids, those that differ from cell to cell (scattered.h), and those that tell by their
// names how a mesh was divided for a run.
// Says in the report what was taken. Throws kBadArgument for a name that is no cell array.
template <class S>
class Regions {
 public:
  explicit Regions(Core<S>& core);
  // Of new cells in the window; the first ones decide.
  void take(uint32_t first, uint32_t end);

 private:
  void decide();
  bool looksLikeIds(int offset, int components) const;
  bool isScattered(int offset, int components, const std::vector<CellPair>& neighbours) const;

  Core<S>& core_;
  bool decided_ = false;
  std::vector<int> columns_;  // candidates, by column
  std::string partitions_;    // names of arrays that are none
};

}  // namespace tetstream
