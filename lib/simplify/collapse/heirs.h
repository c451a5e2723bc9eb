// simplify/collapse: float cell data through a collapse. Depends on mesh.
#pragma once

#include <vector>

#include "patch.h"

namespace tetstream {

// A dying cell u v a b leaves its volume to the cells across u a b and v a b, half to each, or all
// to the one that is there: float cell data stay the mean over what a cell stands for.
class Heirs {
 public:
  // Before v is merged into u; `means` of a cell are behind the volume that it stands for.
  template <class Mesh>
  void handOver(Mesh& mesh, uint32_t v, const Stars& stars, int means);

 private:
  // The cells beyond the faces of a dying cell that become one.
  struct Of {
    uint32_t dying, cell[2], count;
  };

  // Of the stars, a cell that may be an heir.
  struct Beside {
    uint64_t bits;
    const StarCell* cell;
  };

  template <class Mesh>
  void find(Mesh& mesh, uint32_t v, const Stars& stars);
  void listBeside(uint32_t v, const Stars& stars);

  std::vector<Of> heirs_;
  std::vector<Beside> beside_;
  size_t beside_count_ = 0;
};

}  // namespace tetstream
