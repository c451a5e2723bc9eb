#include "id_hash.h"

namespace tetstream {

constexpr size_t kFirstSize = 1024;

void IdHash::add(uint64_t id, uint32_t slot) {
  if (2 * (count_ + 1) > entries_.size()) grow();
  entries_[placeOf(id)] = {id, slot};
  ++count_;
}

// Removing closes the gap, so that no markers pile up: every later entry of the run whose home is
// not after the gap moves into it.
bool IdHash::remove(uint64_t id) {
  if (count_ == 0) return false;
  const size_t mask = entries_.size() - 1;
  size_t gap = placeOf(id);
  if (entries_[gap].slot == kNoSlot) return false;
  for (size_t i = (gap + 1) & mask; entries_[i].slot != kNoSlot; i = (i + 1) & mask) {
    const size_t from_home = (i - homeOf(entries_[i].id)) & mask;
    if (from_home >= ((i - gap) & mask)) {
      entries_[gap] = entries_[i];
      gap = i;
    }
  }
  entries_[gap].slot = kNoSlot;
  --count_;
  return true;
}

void IdHash::clear() {
  for (size_t i = 0; i < entries_.size(); ++i) entries_[i].slot = kNoSlot;
  count_ = 0;
}

void IdHash::grow() {
  Array<Entry> old(entries_.account(), entries_.size() ? 2 * entries_.size() : kFirstSize);
  old.swap(entries_);
  clear();
  for (size_t i = 0; i < old.size(); ++i)
    if (old[i].slot != kNoSlot) add(old[i].id, old[i].slot);
}

}  // namespace tetstream
