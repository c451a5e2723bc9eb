// simplify/intake: the border of a vertex's link: its faces on the boundary of the domain. Depends
// on star_numbers.h, mesh.
#pragma once

#include <vector>

#include "star_numbers.h"
#include "topology.h"

namespace tetstream {

// An edge of the link stands for a face, as its ends: the lower one in the high half.
class LinkBorder {
 public:
  explicit LinkBorder(Account& account) : numbers_(account), corner_places_(account) {}

  // Finds the edges that one cell has; sorted. True if all others are between two cells on both
  // sides of them; false if that is not so, or not certain: then they are not to be used.
  bool find(const Star& star);
  const std::vector<uint64_t>& edges() const { return edges_; }

  // Whether edges, each there once, make a single circle.
  bool isCircle(const std::vector<uint64_t>& edges);

 private:
  void sumEdges(const Star& star);
  void listOpen(const Star& star);
  bool keepSingle();

  StarNumbers numbers_;
  Array<uint32_t> corner_places_;  // of the star's cells, but for the centre
  std::vector<uint64_t> edges_;
  std::vector<uint32_t> ends_;
};

}  // namespace tetstream
