// simplify/state: the volumes of regions, in the input and in the output. Depends on embedded.h.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "embedded.h"

namespace tetstream {

// Each collapse keeps the volumes of the regions round it where that is possible: where several
// meet and few cells are left it is not, and nobody sees it in the volume of all.
class LabelVolumes {
 public:
  enum Side { kInput, kOutput };
  void add(const CellLabels& labels, uint32_t cell, double volume, Side side);
  // Those that changed by more than a percent, the most first; empty if there is none.
  std::string changesInWords() const;

 private:
  using Row = std::vector<int64_t>;
  struct Volumes {
    double of[2] = {0, 0};
    double change() const { return of[kOutput] / of[kInput] - 1; }
  };
  Volumes* volumesOf(const CellLabels& labels, uint32_t cell);

  std::map<Row, Volumes> all_;
  Row row_;  // of the last cell
  Volumes* last_ = nullptr;
};

}  // namespace tetstream
