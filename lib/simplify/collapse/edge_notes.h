// simplify/collapse: what was found of an edge when it was tried last. Depends on base.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "memory.h"

namespace tetstream {

// Of the edges between vertices of a patch, a few thousand: a later one takes the place of another.
// Vertices may have moved or changed hands since.
template <class Value>
class EdgeNotes {
 public:
  explicit EdgeNotes(Account& account) : notes_(account) {}

  void forget() { std::fill_n(notes_.data(), notes_.size(), Note{kNobody, kNobody, {}}); }
  void put(uint32_t u, uint32_t v, Value value) {
    if (u > v) std::swap(u, v);
    if (notes_.size() == 0) {
      notes_.resize(kNotes);
      forget();
    }
    notes_[placeOf(u, v)] = {u, v, value};
  }
  // Null if nothing is known.
  const Value* find(uint32_t u, uint32_t v) const {
    if (notes_.size() == 0) return nullptr;
    if (u > v) std::swap(u, v);
    const Note& last = notes_[placeOf(u, v)];
    return last.u == u && last.v == v ? &last.value : nullptr;
  }

 private:
  struct Note {
    uint32_t u, v;
    Value value;
  };
  static constexpr uint32_t kNotes = 4096, kNobody = 0xffffffffu;
  static uint32_t placeOf(uint32_t u, uint32_t v) { return (u * 61 + v) % kNotes; }

  Array<Note> notes_;
};

}  // namespace tetstream
