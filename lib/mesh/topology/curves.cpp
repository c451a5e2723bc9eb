#include "curves.h"

#include <algorithm>
#include <mutex>

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
  return holds(u, v);
}

bool Curves::passes(uint32_t v) const {
  if (empty()) return false;
  const std::shared_lock lock(mutex_);
  return holdsAny(v);
}

bool Curves::holds(uint32_t u, uint32_t v) const {
  if (count_ == 0) return false;
  for (size_t i = placeOf(u); places_[i] != kEmpty; i = (i + 1) & (places_.size() - 1))
    if (places_[i] == entryOf(u, v)) return true;
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

void Curves::add(uint32_t u, uint32_t v) {
  const std::unique_lock lock(mutex_);
  put(u, v);
  any_ = count_ > 0;
}

void Curves::put(uint32_t u, uint32_t v) {
  if (holds(u, v)) return;
  if (2 * (used_ + 2) > places_.size()) rebuild(count_ + 2, nullptr);
  insert(entryOf(u, v));
  insert(entryOf(v, u));
}

void Curves::merge(uint32_t u, uint32_t v) {
  if (!passes(v)) return;
  const std::unique_lock lock(mutex_);
  while (holdsAny(v)) {
    const auto other = static_cast<uint32_t>(firstOf(v));
    remove(entryOf(v, other));
    remove(entryOf(other, v));
    if (other != u) put(u, other);
  }
  any_ = count_ > 0;
}

void Curves::rebuild(size_t entries, const uint32_t* keep) {
  size_t size = kLeastPlaces;
  while (size < 3 * entries) size *= 2;
  Array<uint64_t> before(*account_, size);
  std::fill_n(before.data(), size, kEmpty);
  before.swap(places_);
  count_ = used_ = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    if (before[i] >= kRemoved) continue;
    const auto u = static_cast<uint32_t>(before[i] >> 32), v = static_cast<uint32_t>(before[i]);
    if (!keep)
      insert(before[i]);
    else if (keep[u] != ~0u && keep[v] != ~0u)
      insert(entryOf(keep[u], keep[v]));
  }
}

void Curves::remap(const uint32_t* keep) {
  const std::unique_lock lock(mutex_);
  if (count_ > 0) rebuild(count_, keep);
  any_ = count_ > 0;
}

}  // namespace tetstream
