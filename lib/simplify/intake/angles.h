// simplify/intake: which angles of cells count. Depends on core.h.
#pragma once

#include "core.h"

namespace tetstream {

// No larger share of cells than the input has comes to lie below a floor, of which there are
// several, and where thin cells are many, or walls are, more of them have a price.
template <class S>
class Angles {
 public:
  explicit Angles(Core<S>& core);

  // Cells [first, end) are new, and their orientation is settled: how thin they are.
  void sample(uint32_t first, uint32_t end);
  // When the faces at their vertices are known.
  void choose(uint32_t first, uint32_t end);

 private:
  bool isRegular(uint32_t cell) const;
  void sampleWalls(uint32_t first, uint32_t end);
  bool isWall() const;
  bool isTooHigh(size_t floor) const;

  Core<S>& core_;
  std::vector<ThinAngle> floors_;  // falling
  std::vector<ThinAngle> near_;    // each so many times its floor
  std::vector<ThinAngle> dear_;
  std::vector<int64_t> below_, below_near_, below_dear_;  // of the cells sampled
  int64_t sampled_ = 0, seen_ = 0;                        // cells
  int64_t wall_cells_ = 0, wall_sampled_ = 0;             // all of whose corners are on faces; all
};

}  // namespace tetstream
