#include "joined_sets.h"

#include <algorithm>

#include "mix.h"
#include "status.h"

namespace tetstream {

uint32_t JoinedSets::make() {
  ++sets_;
  if (free_ != kNone) {
    const uint32_t node = free_;
    free_ = nodes_[node].parent;
    nodes_[node] = {node, 1};
    return node;
  }
  if (used_ == kNone) fail(Status::kNoMemory, "more than 2^32 things at once hang together");
  if (used_ == nodes_.size()) nodes_.resize(std::max<size_t>(256, 2 * nodes_.size()));
  nodes_[used_] = {used_, 1};
  return used_++;
}

void JoinedSets::release(uint32_t member) {
  while (--nodes_[member].held == 0) {
    const uint32_t parent = nodes_[member].parent;
    nodes_[member].parent = free_;
    free_ = member;
    if (parent == member) return;
    member = parent;
  }
}

// Every node on the way moves up to its parent's parent, as long as that leaves the parent held.
uint32_t JoinedSets::root(uint32_t member) {
  while (nodes_[member].parent != member) {
    const uint32_t parent = nodes_[member].parent, above = nodes_[parent].parent;
    if (above != parent) {
      nodes_[member].parent = above;
      ++nodes_[above].held;
      release(parent);
    }
    member = above;
  }
  return member;
}

// The root is the later one in an order of all nodes that is as good as random (Goel, Khanna,
// Larkin, Tarjan, SODA 2014): the way to it, of nodes that may have no other holder, is short even
// from a member that is not looked at for long.
bool JoinedSets::join(uint32_t a, uint32_t b) {
  a = root(a);
  b = root(b);
  if (a == b) return false;
  if (mix(a) < mix(b)) std::swap(a, b);
  nodes_[b].parent = a;
  ++nodes_[a].held;
  --sets_;
  return true;
}

}  // namespace tetstream
