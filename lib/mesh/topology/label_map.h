// mesh/topology: labels of few of many things, by their place in the window. Depends on base.
#pragma once

#include <algorithm>
#include <cstdint>

#include "memory.h"
#include "mix.h"

namespace tetstream {

// A hash from keys of 64-bit numbers (equality and `hash()`) to labels.
template <class Key, class Label = int64_t>
class LabelMap {
 public:
  explicit LabelMap(Account& account) : account_(&account), places_(account) {}

  bool empty() const { return count_ == 0; }
  // Null if there is none; until the next change.
  const Label* find(const Key& key) const {
    if (count_ == 0) return nullptr;
    const size_t i = placeOf(key);
    return places_[i].state == kUsed ? &places_[i].label : nullptr;
  }
  void put(const Key& key, const Label& label) {
    if (4 * (used_ + 1) > 3 * places_.size())
      rebuild(count_ + 1, [](const Key& k, const Label&, Key* kept) {
        *kept = k;
        return true;
      });
    Entry& entry = places_[placeOf(key)];
    if (entry.state != kUsed) {
      ++count_;
      ++used_;
    }
    entry = {key, kUsed, label};
  }
  void remove(const Key& key) {
    if (count_ == 0) return;
    Entry& entry = places_[placeOf(key)];
    if (entry.state != kUsed) return;
    entry.state = kRemoved;
    --count_;
  }
  // moved(key, label&, &kept): the new key, or false where it is to be forgotten.
  template <class Moved>
  void remap(Moved moved) {
    if (count_ > 0) rebuild(count_, moved);
  }
  template <class Visit>
  void forEachLabel(Visit visit) const {
    for (size_t i = 0; i < places_.size(); ++i)
      if (places_[i].state == kUsed) visit(places_[i].label);
  }

 private:
  enum State : uint32_t { kEmpty, kUsed, kRemoved };
  struct Entry {
    Key key;
    State state;  // fills up what a key of 32-bit numbers leaves
    Label label;
  };

  // Of the key, or the empty place where it would be.
  size_t placeOf(const Key& key) const {
    const size_t mask = places_.size() - 1;
    size_t i = static_cast<size_t>(key.hash()) & mask;
    while (places_[i].state != kEmpty && !(places_[i].state == kUsed && places_[i].key == key))
      i = (i + 1) & mask;
    return i;
  }
  template <class Moved>
  void rebuild(size_t entries, Moved moved) {
    size_t size = 64;
    while (size < 2 * entries) size *= 2;
    Array<Entry> before(*account_, size);
    std::fill_n(before.data(), size, Entry{{}, kEmpty, {}});
    before.swap(places_);
    count_ = used_ = 0;
    for (size_t i = 0; i < before.size(); ++i) {
      Key key;
      if (before[i].state != kUsed || !moved(before[i].key, before[i].label, &key)) continue;
      places_[placeOf(key)] = {key, kUsed, before[i].label};
      ++count_;
      ++used_;
    }
  }

  Account* account_;
  Array<Entry> places_;          // a power of two of them, three quarters in use at most
  size_t count_ = 0, used_ = 0;  // entries; places that are in use or were
};

}  // namespace tetstream
