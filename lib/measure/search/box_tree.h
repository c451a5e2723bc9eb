// measure/search: boxes, found by the place where they are. Depends on simplex_rows.h.
//
// A binary tree of boxes, halved at the median of their centres along the longest side, as an array
// in depth-first order (Wald, Boulos, Shirley, ACM TOG 26(1), 2007, section 3).
#pragma once

#include <algorithm>

#include "simplex_rows.h"

namespace tetstream {

class BoxTree {
 public:
  // Of `count` boxes, by number.
  BoxTree(Account& account, const Box* boxes, size_t count);

  // visit(number) for each leaf's item whose box meets the box, and for some near it.
  template <class Visit>
  void forEachNear(const Box& box, Visit&& visit) const {
    forEachNear(
        box, [](uint32_t) { return false; }, visit);
  }
  // Without those of nodes of which isApart(node) knows that they matter not.
  template <class IsApart, class Visit>
  void forEachNear(const Box& box, IsApart&& isApart, Visit&& visit) const {
    for (uint32_t at = 0; at < used_;) {
      const Node& node = nodes_[at];
      if (!node.box.meets(box) || isApart(at)) {
        at = node.next;
        continue;
      }
      for (uint32_t i = node.first; i < node.first + node.count; ++i) visit(items_[i]);
      ++at;
    }
  }

  // The items, nearest boxes first as far as that is cheap. visit(number) gives the squared
  // distance within which further items still matter; `within` is the first one.
  template <class Visit>
  void forEachWithin(const double place[3], double within, Visit&& visit) const {
    forEachWithin(
        place, within, [](uint32_t, double distance, double) { return distance; }, visit);
  }
  // `bound(node, distance, within)`: a lower bound of the squared distance of what is in the node,
  // given that of its box, which is within.
  template <class Bound, class Visit>
  void forEachWithin(const double place[3], double within, Bound&& bound, Visit&& visit) const {
    const auto distanceOf = [&](uint32_t node) {
      const double distance = distanceTo(node, place);
      return distance <= within ? bound(node, distance, within) : distance;
    };
    struct Open {
      uint32_t node;
      double distance;
    } open[kDeepest];
    size_t depth = 0;
    if (used_ > 0) open[depth++] = {0, distanceOf(0)};
    while (depth > 0) {
      const Open top = open[--depth];
      if (top.distance > within) continue;
      const Node& node = nodes_[top.node];
      if (node.count > 0) {
        for (uint32_t i = node.first; i < node.first + node.count; ++i) within = visit(items_[i]);
        continue;
      }
      Open left = {top.node + 1, distanceOf(top.node + 1)};
      const uint32_t other = nodes_[top.node + 1].next;
      Open right = {other, distanceOf(other)};
      if (left.distance < right.distance) std::swap(left, right);
      open[depth++] = left;  // the nearer one is on top
      open[depth++] = right;
    }
  }

  uint32_t nodes() const { return static_cast<uint32_t>(used_); }
  // Each node after its children: leaf(node, items, count) or inner(node, child, other child).
  template <class Leaf, class Inner>
  void forEachNodeUp(Leaf&& leaf, Inner&& inner) const {
    for (uint32_t at = nodes(); at-- > 0;) {
      const Node& node = nodes_[at];
      if (node.count > 0)
        leaf(at, items_.data() + node.first, node.count);
      else
        inner(at, at + 1, nodes_[at + 1].next);
    }
  }

  // Bytes that a tree of so many takes, about and at most.
  static size_t bytesFor(size_t count) {
    return count * (sizeof(uint32_t) + sizeof(Node)) + sizeof(Node);
  }

 private:
  static constexpr size_t kLeaf = 4;       // items, at most
  static constexpr size_t kDeepest = 128;  // halving 2^32 items ends after 32

  // An inner node has no items; its first child follows it. `next` is the node after its subtree.
  struct Node {
    Box box;
    uint32_t next, first, count;
  };
  void build(const Box* boxes, size_t begin, size_t end);
  double distanceTo(uint32_t node, const double place[3]) const {
    const Box& box = nodes_[node].box;
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double out = std::max({box.low[k] - place[k], place[k] - box.high[k], 0.0});
      sum += out * out;
    }
    return sum;
  }

  Array<Node> nodes_;
  Array<uint32_t> items_;
  size_t used_ = 0;
};

}  // namespace tetstream
