#include "region_parts.h"

#include <algorithm>

namespace tetstream {

void RegionParts::add(uint32_t cell, int64_t label, double volume) {
  if (dropped_) return;
  if (!last_ || label != last_label_) {
    last_ = &regions_[label];
    last_label_ = label;
    if (regions_.size() > kMostLabels) {
      dropped_ = true;
      regions_.clear();
      last_ = nullptr;
      return;
    }
  }
  if (cell >= cells_.size())
    cells_.resize(std::max<size_t>({1024, size_t{cell} + 1, cells_.size() + cells_.size() / 2}));
  cells_[cell] = {label, sets_.make()};
  ++last_->cells;
  ++last_->parts;
  last_->volume += volume;
}

void RegionParts::join(uint32_t first, uint32_t second) {
  if (dropped_ || cells_[first].label != cells_[second].label) return;
  if (sets_.join(cells_[first].set, cells_[second].set)) --regions_[cells_[first].label].parts;
}

void RegionParts::remove(uint32_t cell) {
  if (!dropped_) sets_.release(cells_[cell].set);
}

}  // namespace tetstream
