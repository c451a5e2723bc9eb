// simplify/intake: numbers for the vertices of a star, from 0 on, in the order in which they are
// met. Depends on base.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "memory.h"

namespace tetstream {

// A hash with at least twice as many places as vertices, which is forgotten by counting on.
class StarNumbers {
 public:
  explicit StarNumbers(Account& account) : places_(account) {}

  // Forgets all numbers; at most so many vertices will be asked for.
  void start(size_t vertices) {
    const size_t wanted = std::bit_ceil(std::max<size_t>(2 * vertices, 64));
    if (places_.size() < wanted || ++round_ == 0) {
      if (places_.size() < wanted) places_.resize(wanted);
      std::fill_n(places_.data(), places_.size(), Place{0, 0});
      round_ = 1;
    }
    mask_ = wanted - 1;
    count_ = 0;
  }
  uint32_t numberOf(uint32_t vertex) {
    return static_cast<uint32_t>(valueAt(placeOf(vertex, count_)));
  }
  uint32_t count() const { return count_; }

  // Instead of its number a vertex may have a value of another meaning: `first` when it is met.
  uint32_t placeOf(uint32_t vertex, uint64_t first) {
    const uint64_t wanted = uint64_t{round_} << 32 | vertex;
    for (size_t at = (vertex * uint64_t{0x9e3779b97f4a7c15} >> 32) & mask_;;
         at = (at + 1) & mask_) {
      Place& place = places_[at];
      if (place.key == wanted) return static_cast<uint32_t>(at);
      if (place.key >> 32 == round_) continue;
      place = {wanted, first};
      ++count_;
      return static_cast<uint32_t>(at);
    }
  }
  uint64_t& valueAt(uint32_t place) { return places_[place].value; }

 private:
  struct Place {
    uint64_t key;  // the round and the vertex
    uint64_t value;
  };
  Array<Place> places_;
  size_t mask_ = 0;
  uint32_t round_ = 0, count_ = 0;
};

}  // namespace tetstream
