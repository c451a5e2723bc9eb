#include "curves.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "mix.h"

namespace tetstream {

constexpr size_t kLeastPlaces = 64;

size_t Curves::placeOf(uint32_t v) const {
  return static_cast<size_t>(mix(v)) & (places_.size() - 1);
}

uint64_t Curves::firstOf(uint32_t v) const {
  for (size_t i = placeOf(v);; i = (i + 1) & (places_.size() - 1))
    if (places_[i] == kEmpty || places_[i] >> 32 == v) return places_[i];
}

bool Curves::has(uint32_t u, uint32_t v) const {
  if (empty()) return false;
  const std::shared_lock lock(mutex_);
  return find(u, v) != kEmpty;
}

bool Curves::leads(uint32_t u, uint32_t v) const {
  if (empty()) return false;
  const std::shared_lock lock(mutex_);
  const uint64_t edge = find(u, v);
  if (edge == kEmpty || !(edge & kFold)) return edge != kEmpty;
  return !isOnStratum(u) || !isOnStratum(v);
}

bool Curves::passes(uint32_t v) const {
  if (empty()) return false;
  const std::shared_lock lock(mutex_);
  return holdsAny(v);
}

// The entry of u; kEmpty if there is none.
uint64_t Curves::find(uint32_t u, uint32_t v) const {
  if (count_ == 0) return kEmpty;
  size_t i = placeOf(u);
  while (places_[i] != kEmpty && (places_[i] & ~kFold) != entryOf(u, v))
    i = (i + 1) & (places_.size() - 1);
  return places_[i];
}

bool Curves::isOnStratum(uint32_t v) const {
  for (size_t i = placeOf(v); places_[i] != kEmpty; i = (i + 1) & (places_.size() - 1))
    if (places_[i] >> 32 == v && !(places_[i] & kFold)) return true;
  return false;
}

void Curves::insert(uint64_t entry) {
  size_t i = placeOf(static_cast<uint32_t>(entry >> 32));
  while (places_[i] != kEmpty) i = (i + 1) & (places_.size() - 1);
  places_[i] = entry;
  ++used_;
  ++count_;
}

void Curves::remove(uint64_t entry) {
  size_t i = placeOf(static_cast<uint32_t>(entry >> 32));
  while (places_[i] != entry) i = (i + 1) & (places_.size() - 1);
  places_[i] = kRemoved;
  --count_;
}

void Curves::add(uint32_t u, uint32_t v, bool is_fold) {
  const std::unique_lock lock(mutex_);
  put(u, v, is_fold ? kFold : 0);
  any_ = count_ > 0;
}

void Curves::put(uint32_t u, uint32_t v, uint64_t fold) {
  if (const uint64_t there = find(u, v); there != kEmpty) {
    if (fold || !(there & kFold)) return;
    remove(there);
    remove(entryOf(v, u) | kFold);
  }
  if (2 * (used_ + 2) > places_.size()) rebuild(2, nullptr);
  insert(entryOf(u, v) | fold);
  insert(entryOf(v, u) | fold);
}

void Curves::merge(uint32_t u, uint32_t v) {
  if (!passes(v)) return;
  const std::unique_lock lock(mutex_);
  while (holdsAny(v)) {
    const uint64_t edge = firstOf(v), fold = edge & kFold;
    const uint32_t other = otherOf(edge);
    remove(edge);
    remove(entryOf(other, v) | fold);
    if (other != u) put(u, other, fold);
  }
  any_ = count_ > 0;
}

// In place: where memory is short a copy would be as large as what it is made of. Entries wait
// where they are until it is their turn; one that another finds at its place goes next.
void Curves::rebuild(size_t more, const uint32_t* keep) {
  const size_t before = places_.size();
  size_t left = more, size = kLeastPlaces;
  for (size_t i = 0; i < before; ++i) left += renamed(places_[i], keep) != kEmpty;
  while (size < 3 * left) size *= 2;
  if (more == 0) size = std::min(size, before);
  if (size > before) {
    places_.resize(size);
    std::fill(places_.data() + before, places_.data() + size, kEmpty);
  }
  for (size_t i = 0; i < before; ++i) places_[i] = renamed(places_[i], keep);
  count_ = 0;
  for (size_t i = 0; i < before; ++i)
    if (waits(places_[i])) place(std::exchange(places_[i], kEmpty), size - 1);
  used_ = count_;
  if (size < before) places_.resize(size);
}

// Of one that waits, or is empty.
uint64_t Curves::renamed(uint64_t entry, const uint32_t* keep) {
  if (entry >= kRemoved) return kEmpty;
  if (!keep) return entry | kWaits;
  const uint32_t u = keep[entry >> 32], v = keep[otherOf(entry)];
  return u == ~0u || v == ~0u ? kEmpty : entryOf(u, v) | (entry & kFold) | kWaits;
}

void Curves::place(uint64_t entry, size_t mask) {
  while (entry != kEmpty) {
    entry &= ~kWaits;
    size_t i = static_cast<size_t>(mix(entry >> 32)) & mask;
    while (places_[i] != kEmpty && !waits(places_[i])) i = (i + 1) & mask;
    std::swap(entry, places_[i]);
    ++count_;
  }
}

void Curves::remap(const uint32_t* keep) {
  const std::unique_lock lock(mutex_);
  if (count_ > 0) rebuild(0, keep);
  any_ = count_ > 0;
}

}  // namespace tetstream
