// measure/search: what the nodes of a tree hold, told more closely than by boxes where very many
// cells or triangles meet at a place. Depends on box_tree.h, hubs.h, barycentric.h.
//
// The boxes of n cells round a hub all meet there, however the tree is halved, and so does each of
// n cells round it meet them all. But a node's cells lie in the convex hull of their hubs and of
// the box of their other corners, and from a cell that has that hub, too, this is parted by one of
// the cell's sides.
#pragma once

#include "box_tree.h"
#include "hubs.h"

namespace tetstream {

// The four sides of a cell: its barycentric coordinates, as their gradients and a place where they
// are 0. Those of a flat cell are no numbers, and nothing is beyond.
struct CellSides {
  explicit CellSides(const double* corners);  // [4][3]
  double gradient[4][3];
  const double* upon[4];
};

class HubHulls {
 public:
  explicit HubHulls(const Hubs& hubs, Account& account) : hubs_(hubs), hulls_(account) {}
  void build(const BoxTree& tree, const RowView& rows);

  // Whether the node is beyond one of the sides: it has nothing in common with the cell but some
  // hubs, up to rounding.
  bool isBeyond(uint32_t node, const CellSides& sides) const;
  // A lower bound of the squared distance of what is in the node; 0 where it has no hub, or its
  // hull comes within that squared distance.
  double leastSquared(uint32_t node, const double place[3], double within) const;

  static constexpr size_t kBytesOfNode = 56;

 private:
  static constexpr uint32_t kMostHubs = 3;  // nodes with more, near the root, have none
  struct Hull {
    Box others;  // of the corners that are no hubs of the node
    uint16_t count, hubs[kMostHubs];
  };
  static_assert(sizeof(Hull) == kBytesOfNode);
  static_assert(4 * Hubs::kSample / Hubs::kManyRows < (1 << 16));  // hubs, at most

  const double* hub(const Hull& hull, uint32_t i) const { return hubs_.place(hull.hubs[i]); }
  void addHub(Hull& hull, uint32_t hub) const;
  void addCorner(Hull& hull, const double place[3]) const;
  bool isBeyond(const Hull& hull, const double gradient[3], const double upon[3]) const;
  void leastAlong(const Hull& hull, const double from[3], const double along[3],
                  double out[3]) const;

  const Hubs& hubs_;
  Array<Hull> hulls_;  // by node
};

}  // namespace tetstream
