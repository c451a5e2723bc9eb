// measure/scan: which things hang together, while most of them come and go. Depends on base.
//
// A forest of sets (Tarjan, J. ACM 22(2), 1975) whose members are counted: one that nobody holds
// and that is nobody's parent is used again, so that memory is that of the members held at once.
#pragma once

#include "memory.h"

namespace tetstream {

class JoinedSets {
 public:
  explicit JoinedSets(Account& account) : nodes_(account) {}
  uint32_t make();  // a set of its own; held once
  void release(uint32_t member);
  bool join(uint32_t a, uint32_t b);      // false if they were in one set
  int64_t sets() const { return sets_; }  // ever made and not joined

 private:
  static constexpr uint32_t kNone = 0xffffffffu;
  struct Node {
    uint32_t parent;  // itself for a root; of free ones the next
    uint32_t held;    // by the caller and by children
  };
  uint32_t root(uint32_t member);

  Array<Node> nodes_;
  uint32_t used_ = 0, free_ = kNone;
  int64_t sets_ = 0;
};

}  // namespace tetstream
