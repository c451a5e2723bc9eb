#include "front.h"

#include <utility>

namespace tetstream {

// The first ring has 1024 entries, 8 KB; one that a header asks for has 2^20 at most, 8 MB.
constexpr unsigned kSmallestBits = 10, kLargestFirstBits = 20;
// The ring doubles when more than 1/8 of its size was displaced into the hash.
constexpr unsigned kDisplacedShare = 8;

Front::Front(Account& account, uint64_t expected_span)
    : ring_(account), hash_(account), bits_(kSmallestBits) {
  while (bits_ < kLargestFirstBits && (uint64_t{1} << bits_) < expected_span) ++bits_;
  mask_ = (uint64_t{1} << bits_) - 1;
  ring_.resize(mask_ + 1);
  for (size_t i = 0; i < ring_.size(); ++i) ring_[i] = {0, kNoSlot};
}

void Front::introduce(uint32_t slot) {
  if (active_ == 0) lowest_ = next_;
  place(next_, slot);
  ++active_;
  if (active_ > width_) width_ = active_;
  const uint64_t span = next_ - lowest_ + 1;
  if (span > span_) span_ = span;
  ++next_;
}

void Front::place(uint64_t vertex, uint32_t slot) {
  if (ring_[vertex & mask_].slot != kNoSlot && hash_.count() > ring_.size() / kDisplacedShare)
    growRing();
  Entry& e = ring_[vertex & mask_];
  if (e.slot != kNoSlot) hash_.add(vertexAt(vertex & mask_), e.slot);
  e = {tagOf(vertex), slot};
}

bool Front::finalize(uint64_t vertex) {
  Entry& e = ring_[vertex & mask_];
  if (e.slot != kNoSlot && e.tag == tagOf(vertex))
    e.slot = kNoSlot;
  else if (!hash_.remove(vertex))
    return false;
  --active_;
  if (active_ > 0 && vertex == lowest_)
    while (find(lowest_) == kNoSlot) ++lowest_;
  return true;
}

void Front::remap(const uint32_t* new_slot) {
  for (size_t i = 0; i < ring_.size(); ++i)
    if (ring_[i].slot != kNoSlot) ring_[i].slot = new_slot[ring_[i].slot];
  hash_.forEach([new_slot](uint64_t, uint32_t& slot) { slot = new_slot[slot]; });
}

// Doubling splits each place in two: what is in the ring stays in it, and what was displaced may
// come back.
void Front::growRing() {
  const size_t old_size = ring_.size();
  const unsigned old_bits = bits_;
  ring_.resize(2 * old_size);
  for (size_t i = old_size; i < 2 * old_size; ++i) ring_[i] = {0, kNoSlot};
  bits_ = old_bits + 1;
  mask_ = 2 * old_size - 1;
  for (size_t i = 0; i < old_size; ++i) {
    if (ring_[i].slot == kNoSlot) continue;
    const uint64_t vertex = static_cast<uint64_t>(ring_[i].tag) << old_bits | i;
    const Entry moved = {tagOf(vertex), ring_[i].slot};
    ring_[i].slot = kNoSlot;
    ring_[vertex & mask_] = moved;
  }
  IdHash displaced(std::move(hash_));
  hash_.clear();
  displaced.forEach([this](uint64_t vertex, uint32_t slot) {
    Entry& e = ring_[vertex & mask_];
    if (e.slot == kNoSlot)
      e = {tagOf(vertex), slot};
    else
      hash_.add(vertex, slot);
  });
}

}  // namespace tetstream
