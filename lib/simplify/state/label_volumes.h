// simplify/state: the volumes of regions, in the input and in the output. Depends on embedded.h.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "embedded.h"

namespace tetstream {

// Each collapse keeps the volumes of the regions round it where that is possible: where several
// meet and few cells are left it is not, and nobody sees it in the volume of all.
class LabelVolumes {
 public:
  enum Side { kInput, kOutput };
  void add(const CellLabels& labels, uint32_t cell, double volume, Side side);
  struct Volumes {
    double of[2] = {0, 0};  // by side, as far as the region was read or written
    double change() const { return of[kOutput] / of[kInput] - 1; }
  };
  // Of the region that a row of labels tells; null where none are kept. They stay where they are.
  const Volumes* find(const CellLabels& labels, const int64_t* row) const;
  // Those that changed by more than a percent, the most first; empty if there is none.
  std::string changesInWords() const;

 private:
  using Row = std::vector<int64_t>;
  // Of a cell, with what does not count.
  struct Labelled {
    const CellLabels& labels;
    const int64_t* row;
  };
  struct Less {
    using is_transparent = void;
    bool operator()(const Row& a, const Row& b) const { return a < b; }
    bool operator()(const Row& a, const Labelled& b) const { return compare(a, b) < 0; }
    bool operator()(const Labelled& a, const Row& b) const { return compare(b, a) > 0; }

    static int compare(const Row& a, const Labelled& b);
  };
  Volumes* volumesOf(const CellLabels& labels, uint32_t cell);

  std::map<Row, Volumes, Less> all_;
  std::pair<const Row, Volumes>* last_ = nullptr;  // that was asked for
};

}  // namespace tetstream
