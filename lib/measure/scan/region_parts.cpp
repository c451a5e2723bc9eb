#include "region_parts.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace tetstream {

// Some labels tell; looked at again whenever there are twice as many. Where cells come in any order
// the first ones of thousands of labels are nearly all different, too, but for some; of so many
// that memory counts half of them will do.
constexpr size_t kLabelsThatTell = 1024, kManyLabels = 1 << 16;
// Of a label: its node in the map, and its row in the comparison, which has room to grow.
constexpr size_t kLabelBytes = 192;

bool RegionParts::looksLikeIds() const {
  const size_t labels = regions_.size();
  const int64_t ids = labels < kManyLabels ? cells_seen_ / 16 * 15 : cells_seen_ / 2;
  return labels >= kLabelsThatTell && std::has_single_bit(labels) &&
         static_cast<int64_t>(labels) > ids;
}

void RegionParts::drop() {
  dropped_ = true;
  regions_.clear();
  last_ = nullptr;
  account_.release(std::exchange(charged_, 0));
}

void RegionParts::addRegion(int64_t label) {
  last_label_ = label;
  if (const auto known = regions_.find(label); known != regions_.end()) {
    last_ = &known->second;
    return;
  }
  account_.charge(kLabelBytes);
  charged_ += kLabelBytes;
  last_ = &regions_[label];
  if (drops_ids_ && looksLikeIds()) drop();
}

void RegionParts::add(uint32_t cell, int64_t label, double volume) {
  if (dropped_) return;
  ++cells_seen_;
  if (!last_ || label != last_label_) addRegion(label);
  if (dropped_) return;
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
