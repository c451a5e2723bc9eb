// stream: numbers for some of many ids, which come and go. Depends on base.
#pragma once

#include <cstdint>
#include <utility>

#include "memory.h"

namespace tetstream {

constexpr uint32_t kNoSlot = 0xffffffffu;

// Open addressing, linear probes, at most half full. No entry takes memory before the first add.
class IdHash {
 public:
  explicit IdHash(Account& account) : entries_(account) {}
  IdHash(IdHash&& other) noexcept
      : entries_(std::move(other.entries_)), count_(std::exchange(other.count_, 0)) {}

  size_t count() const { return count_; }
  uint32_t find(uint64_t id) const { return count_ == 0 ? kNoSlot : entries_[placeOf(id)].slot; }
  void add(uint64_t id, uint32_t slot);  // which is not there; slot: not kNoSlot
  bool remove(uint64_t id);              // false if it was not there
  void clear();
  template <class Visit>
  void forEach(Visit visit) {  // visit(uint64_t id, uint32_t& slot)
    for (size_t i = 0; i < entries_.size(); ++i)
      if (entries_[i].slot != kNoSlot) visit(entries_[i].id, entries_[i].slot);
  }

 private:
  struct Entry {
    uint64_t id;
    uint32_t slot;  // kNoSlot: free
  };
  size_t homeOf(uint64_t id) const {
    return static_cast<size_t>((id * 0x9e3779b97f4a7c15ull) >> 20) & (entries_.size() - 1);
  }
  // Of the id's entry, or the free one where it would be.
  size_t placeOf(uint64_t id) const {
    size_t i = homeOf(id);
    while (entries_[i].slot != kNoSlot && entries_[i].id != id) i = (i + 1) & (entries_.size() - 1);
    return i;
  }
  void grow();

  Array<Entry> entries_;
  size_t count_ = 0;
};

}  // namespace tetstream
