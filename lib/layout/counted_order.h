// layout: the cells of a mesh in memory in the order of their last vertices, by counting. What a
// sort of records takes, 48 bytes a cell and as much again while it grows, becomes 4 bytes a cell
// and 8 a point. Depends on mesh_reading.h, memory.h.
#pragma once

#include "memory.h"
#include "mesh_reading.h"

namespace tetstream {

class CountedCells {
 public:
  // Whether this can do it: single rows are cheap, and it fits the memory.
  static bool serves(const IndexedSource& source, size_t memory_bytes);

  // `ranks` of all points, below `vertices`. By the highest rank, equal ones as they are in the
  // mesh.
  CountedCells(IndexedSource& source, const Array<uint32_t>& ranks, uint64_t vertices,
               Account& account, const Tell& tell);

  size_t count() const { return cells_.size(); }
  uint32_t operator[](size_t place) const { return cells_[place]; }

 private:
  Array<uint32_t> cells_;
};

}  // namespace tetstream
