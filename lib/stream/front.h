// stream: the front, the vertices that were introduced and are not yet finalized, and where the
// consumer keeps each of them. Depends on base.
//
// After Vo et al. 2007, section 4: a circular array addressed by the vertex rank modulo its size
// serves streams of low span; a vertex that lives so long that a younger one claims its place moves
// to an auxiliary hash. The array doubles while many vertices are displaced, so it ends near the
// span of a well laid out stream and near the width of a bad one.
#pragma once

#include <cstdint>

#include "id_hash.h"

namespace tetstream {

class Front {
 public:
  explicit Front(Account& account, uint64_t expected_span = 0);

  // Makes the next rank active: ranks are introduced one after the other, from 0.
  void introduce(uint32_t slot);
  uint64_t introduced() const { return next_; }

  // The slot of an active vertex, or kNoSlot. Of those that were introduced: others may be taken
  // for one of them.
  uint32_t find(uint64_t vertex) const {
    const Entry& e = ring_[vertex & mask_];
    if (e.slot != kNoSlot && e.tag == tagOf(vertex)) return e.slot;
    return hash_.find(vertex);
  }
  // The slots of four; false, and of no use, where one is not active or not in the ring.
  bool findFour(const int64_t vertices[4], uint32_t slots[4]) const {
    const Entry* const ring = ring_.data();
    const uint64_t mask = mask_;
    const unsigned bits = bits_;
    uint64_t wrong = 0;
    uint32_t largest = 0;
    for (int j = 0; j < 4; ++j) {
      const auto vertex = static_cast<uint64_t>(vertices[j]);
      const Entry e = ring[vertex & mask];
      wrong |= e.tag ^ (vertex >> bits);  // all of its bits: none that was not introduced has them
      slots[j] = e.slot;
      largest |= e.slot;
    }
    return (wrong | largest >> 31) == 0;  // kNoSlot has the last bit
  }
  // Makes an active vertex inactive; false if it was not active. As for find.
  bool finalize(uint64_t vertex);
  // slot = new_slot[slot] for every active vertex.
  void remap(const uint32_t* new_slot);

  uint64_t active() const { return active_; }
  uint64_t lowest() const { return lowest_; }  // of the active vertices, if there are any
  int64_t width() const { return static_cast<int64_t>(width_); }  // largest so far
  int64_t span() const { return static_cast<int64_t>(span_); }    // largest so far

 private:
  struct Entry {
    uint32_t tag, slot;  // tag: the rank without its low bits; slot kNoSlot: free
  };
  uint32_t tagOf(uint64_t vertex) const { return static_cast<uint32_t>(vertex >> bits_); }
  uint64_t vertexAt(size_t index) const {
    return static_cast<uint64_t>(ring_[index].tag) << bits_ | index;
  }
  void place(uint64_t vertex, uint32_t slot);
  void growRing();

  Array<Entry> ring_;
  IdHash hash_;
  unsigned bits_;
  uint64_t mask_;
  uint64_t next_ = 0, lowest_ = 0;  // lowest_: no active vertex is below
  uint64_t active_ = 0, width_ = 0, span_ = 0;
};

}  // namespace tetstream
