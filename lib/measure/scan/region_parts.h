// measure/scan: the regions that a cell array labels: volume, cells, parts. Depends on
// joined_sets.h.
#pragma once

#include <map>

#include "joined_sets.h"

namespace tetstream {

struct RegionFigures {
  int64_t cells = 0;
  int64_t parts = 0;  // sets of cells joined through faces
  double volume = 0;
};

// Of one array.
class RegionParts {
 public:
  // With `drops_ids` an array of ids is dropped: of which hardly any comes twice or, where there
  // are very many, more than one comes for two cells. Otherwise there are as many labels as the
  // account allows.
  RegionParts(Account& account, bool drops_ids)
      : account_(account), drops_ids_(drops_ids), sets_(account), cells_(account) {}
  ~RegionParts() { account_.release(charged_); }
  RegionParts(const RegionParts&) = delete;
  RegionParts& operator=(const RegionParts&) = delete;

  // Cells are the caller's small numbers, used again after `remove`.
  void add(uint32_t cell, int64_t label, double volume);
  void join(uint32_t first, uint32_t second);
  void remove(uint32_t cell);

  void drop();  // it tells nothing from now on
  bool dropped() const { return dropped_; }
  const std::map<int64_t, RegionFigures>& regions() const { return regions_; }

 private:
  struct Cell {
    int64_t label;
    uint32_t set;
  };
  void addRegion(int64_t label);
  bool looksLikeIds() const;

  Account& account_;
  bool drops_ids_;
  size_t charged_ = 0;
  int64_t cells_seen_ = 0;
  JoinedSets sets_;
  Array<Cell> cells_;
  std::map<int64_t, RegionFigures> regions_;
  RegionFigures* last_ = nullptr;  // the region of last_label_
  int64_t last_label_ = 0;
  bool dropped_ = false;
};

}  // namespace tetstream
