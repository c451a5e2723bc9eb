// simplify/collapse: vertices none of whose cells is thin. Depends on mesh.
#pragma once

#include <algorithm>

#include "memory.h"
#include "topology.h"

namespace tetstream {

// Where both ends of an edge are sound its collapse may leave no thin cell, and the first that it
// would leave tells. What is not known counts as not sound.
class SoundVertices {
 public:
  explicit SoundVertices(Account& account) : sound_(account) {}

  void forget() { std::fill_n(sound_.data(), sound_.size(), uint8_t{0}); }
  bool has(uint32_t v) const { return v < sound_.size() && sound_[v]; }
  void add(uint32_t v) {
    if (v >= sound_.size()) {
      const size_t before = sound_.size();
      sound_.resize(size_t{v} + 1024);
      std::fill(sound_.data() + before, sound_.data() + sound_.size(), uint8_t{0});
    }
    sound_[v] = 1;
  }
  // u was merged: the cells are those of the stars, with it at their centres.
  void merged(uint32_t u, const Stars& stars, bool leaves_thin) {
    if (!leaves_thin) return add(u);
    drop(u);
    for (const Star* star : {&stars.u, &stars.v})
      for (const StarCell& s : *star)
        for (uint32_t t : s.t) drop(t);
  }

 private:
  void drop(uint32_t v) {
    if (has(v)) sound_[v] = 0;
  }

  Array<uint8_t> sound_;
};

}  // namespace tetstream
