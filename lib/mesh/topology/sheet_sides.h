// mesh/topology: the parts into which sheets cut the cells round an edge. Depends on strata.h.
#pragma once

#include <vector>

#include "strata.h"

namespace tetstream {

// Cells on the two sides of a labelled face inside a region have one label: what tells them apart
// is that no way leads from the one to the other but through the face.
class SheetSides {
 public:
  // Of the cells of both stars, without the outside. Returns how many parts there are.
  size_t find(const Stars& stars, const CellLabels& labels,
              const StrataCondition::Labelled& labelled);
  // The part, below that number, of a cell by its place among those of stars.u, of stars.ring and
  // of stars.v, in this order.
  size_t of(size_t place) const { return part_[place]; }

 private:
  struct Face {  // of an end: an edge of its link, and a cell there by its place
    uint64_t link;
    uint32_t cell, place;
  };

  void addFaces(const StarCell& cell, uint32_t place);
  void join(const CellLabels& labels, const std::vector<uint64_t>& labelled);
  uint32_t first(uint32_t place);

  std::vector<Face> faces_;
  std::vector<uint32_t> above_;  // of each place one of its part; the first has itself
  std::vector<uint32_t> part_;
};

}  // namespace tetstream
