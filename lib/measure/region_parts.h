// measure: the regions that a cell array labels: volume, cells, parts. Depends on joined_sets.h.
#pragma once

#include <map>

#include "joined_sets.h"

namespace tetstream {

struct RegionFigures {
  int64_t cells = 0;
  int64_t parts = 0;  // sets of cells joined through faces
  double volume = 0;
};

// Of one array. An array with more labels than kMostLabels numbers its cells, and is dropped.
class RegionParts {
 public:
  static constexpr size_t kMostLabels = 65536;

  explicit RegionParts(Account& account) : sets_(account), cells_(account) {}
  // Cells are the caller's small numbers, used again after `remove`.
  void add(uint32_t cell, int64_t label, double volume);
  void join(uint32_t first, uint32_t second);
  void remove(uint32_t cell);

  bool dropped() const { return dropped_; }
  const std::map<int64_t, RegionFigures>& regions() const { return regions_; }

 private:
  struct Cell {
    int64_t label;
    uint32_t set;
  };
  JoinedSets sets_;
  Array<Cell> cells_;
  std::map<int64_t, RegionFigures> regions_;
  RegionFigures* last_ = nullptr;  // the region of last_label_
  int64_t last_label_ = 0;
  bool dropped_ = false;
};

}  // namespace tetstream
