// simplify/collapse: which cells are thin, as those of an edge's stars are counted. Depends on
// core.h, mesh.
#pragma once

#include <type_traits>

#include "core.h"
#include "patch.h"
#include "star_kernels.h"

namespace tetstream {

// Where many cells are thin most edges are refused for them, and the same cells are counted for
// each: there each cell of a patch is measured once, when it is first asked for, and again when its
// corners have changed. In other meshes, where that takes longer, and in the window, where cells
// change their places, those of a star are measured each time.
template <class Mesh>
class ThinCounts {
 public:
  using S = typename Mesh::Scalar;
  // The angles below which a cell is thin: the floor, and of those that have their price the first
  // and the last.
  enum Angle : unsigned { kFloor, kFirstDear, kLastDear };

  ThinCounts(const Core<S>& core, const Mesh& mesh, Account& account)
      : core_(core), mesh_(mesh), known_(account) {}

  // Before work on another mesh, or with other angles.
  void forget() { size_ = 0; }
  // The live cells of u and v, as gathered.
  size_t count(uint32_t u, uint32_t v, const Stars& stars, Angle angle) {
    return countIn(stars.u, u, angle) + countIn(stars.ring, u, angle) + countIn(stars.v, v, angle);
  }
  // The cells of both stars but the ring have other corners now.
  void merged(const Stars& stars) {
    if (size_ == 0) return;
    for (const Star* star : {&stars.u, &stars.v})
      for (const StarCell& s : *star) known_[s.cell] = 0;
  }

 private:
  bool remembers() const { return std::is_same_v<Mesh, Patch<S>> && core_.isFlat(); }
  static constexpr unsigned kAngles = 3;
  static constexpr uint8_t kKnown = 1 << kAngles;  // a bit for each angle, and this one

  size_t countIn(const Star& star, uint32_t centre, Angle angle);
  size_t measureIn(const Star& star, uint32_t centre, Angle angle) const;
  size_t measure(const uint32_t* cells, size_t count, Angle angle);
  void start();
  const ThinAngle& angleOf(Angle angle) const {
    return angle == kFloor || core_.dear.empty() ? core_.thin
           : angle == kFirstDear                 ? core_.dear.front()
                                                 : core_.dear.back();
  }

  const Core<S>& core_;
  const Mesh& mesh_;
  Array<uint8_t> known_;  // of the first cells of the patch, if any are
  size_t size_ = 0;
  double cos2_[kAngles] = {};
};

}  // namespace tetstream
