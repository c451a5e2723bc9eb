// tests/support: meshes small enough to draw, and where the real ones are.
#pragma once

#include <string>
#include <vector>

#include "memory_source.h"
#include "source.h"

namespace tetstream::test {

// An indexed mesh that owns its arrays; double positions, one double field "f" unless changed.
struct SmallMesh {
  std::vector<double> positions, field;
  std::vector<int64_t> cells;
  Schema schema() const;
  BatchView view();
  size_t vertexCount() const { return positions.size() / 3; }
  size_t cellCount() const { return cells.size() / 4; }

 private:
  const void* fields_[1] = {nullptr};
};

// nx x ny x nz unit cubes of six cells each, vertices in lexicographic order, f = x + 2y + 3z.
SmallMesh gridMesh(int nx, int ny, int nz);

}  // namespace tetstream::test
