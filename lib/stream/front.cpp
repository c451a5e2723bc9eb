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
  if (ring_[vertex & mask_].slot != kNoSlot && hash_count_ > ring_.size() / kDisplacedShare)
    growRing();
  Entry& e = ring_[vertex & mask_];
  if (e.slot != kNoSlot) addToHash(vertexAt(vertex & mask_), e.slot);
  e = {tagOf(vertex), slot};
}

bool Front::finalize(uint64_t vertex) {
  Entry& e = ring_[vertex & mask_];
  if (e.slot != kNoSlot && e.tag == tagOf(vertex))
    e.slot = kNoSlot;
  else if (hash_count_ == 0 || !removeFromHash(vertex))
    return false;
  --active_;
  if (active_ > 0 && vertex == lowest_)
    while (find(lowest_) == kNoSlot) ++lowest_;
  return true;
}

void Front::remap(const uint32_t* new_slot) {
  for (size_t i = 0; i < ring_.size(); ++i)
    if (ring_[i].slot != kNoSlot) ring_[i].slot = new_slot[ring_[i].slot];
  for (size_t i = 0; i < hash_.size(); ++i)
    if (hash_[i].slot != kNoSlot) hash_[i].slot = new_slot[hash_[i].slot];
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
  Array<HashEntry> displaced(std::move(hash_));
  const size_t count = displaced.size();
  hash_count_ = 0;
  for (size_t i = 0; i < count; ++i) {
    if (displaced[i].slot == kNoSlot) continue;
    Entry& e = ring_[displaced[i].vertex & mask_];
    if (e.slot == kNoSlot)
      e = {tagOf(displaced[i].vertex), displaced[i].slot};
    else
      addToHash(displaced[i].vertex, displaced[i].slot);
  }
}

// --------------------------------------------------------------------------- the auxiliary hash

size_t Front::homeOf(uint64_t vertex) const {
  return static_cast<size_t>((vertex * 0x9e3779b97f4a7c15ull) >> 20) & (hash_.size() - 1);
}

uint32_t Front::findInHash(uint64_t vertex) const {
  for (size_t i = homeOf(vertex); hash_[i].slot != kNoSlot; i = (i + 1) & (hash_.size() - 1))
    if (hash_[i].vertex == vertex) return hash_[i].slot;
  return kNoSlot;
}

void Front::addToHash(uint64_t vertex, uint32_t slot) {
  if (2 * (hash_count_ + 1) > hash_.size()) growHash();
  size_t i = homeOf(vertex);
  while (hash_[i].slot != kNoSlot) i = (i + 1) & (hash_.size() - 1);
  hash_[i] = {vertex, slot};
  ++hash_count_;
}

// Removing closes the gap, so that no markers pile up: every later entry of the run whose home is
// not after the gap moves into it.
bool Front::removeFromHash(uint64_t vertex) {
  const size_t mask = hash_.size() - 1;
  size_t gap = homeOf(vertex);
  while (hash_[gap].slot != kNoSlot && hash_[gap].vertex != vertex) gap = (gap + 1) & mask;
  if (hash_[gap].slot == kNoSlot) return false;
  for (size_t i = (gap + 1) & mask; hash_[i].slot != kNoSlot; i = (i + 1) & mask) {
    const size_t from_home = (i - homeOf(hash_[i].vertex)) & mask;
    if (from_home >= ((i - gap) & mask)) {
      hash_[gap] = hash_[i];
      gap = i;
    }
  }
  hash_[gap].slot = kNoSlot;
  --hash_count_;
  return true;
}

void Front::growHash() {
  Array<HashEntry> old(std::move(hash_));
  const size_t size = old.size() ? 2 * old.size() : 1024;
  hash_.resize(size);
  for (size_t i = 0; i < size; ++i) hash_[i] = {0, kNoSlot};
  hash_count_ = 0;
  for (size_t i = 0; i < old.size(); ++i)
    if (old[i].slot != kNoSlot) addToHash(old[i].vertex, old[i].slot);
}

}  // namespace tetstream
