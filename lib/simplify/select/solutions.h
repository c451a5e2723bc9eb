// simplify/select: the minimizers of edges that are about to be tried, found several at once: one
// alone takes as long, since each of its steps waits for the last. Depends on core.h.
#pragma once

#include "core.h"

namespace tetstream {

template <class S>
class Solutions {
 public:
  Solutions(const Core<S>& core, Account& account)
      : core_(core), moved_(account), z_(static_cast<size_t>(core.plan.dimension) * kEdgeLanes) {}

  // For another patch, with that many owned vertices.
  void reset(size_t vertices) {
    if (moved_.size() < vertices) moved_.resize(vertices + 1024);
    std::fill_n(moved_.data(), vertices, 0u);
    clock_ = 0;
    clear();
  }
  void clear() { count_ = next_ = 0; }

  // Edges are added by rising vertex, and asked for in that order.
  bool full() const { return count_ == kEdgeLanes; }
  void add(uint32_t v, uint32_t w) {
    ends_[2 * count_] = v;
    ends_[2 * count_ + 1] = w;
    ++count_;
  }
  void solve(const VertexTable<S>& table) {
    core_.kernels.solveEdges(table, ends_, count_, core_.scale.data(), core_.plan.dimension,
                             z_.data(), errors_);
    solved_ = clock_;
  }
  // The vertex was merged with another: what is known of its edges is void.
  void moved(uint32_t v) { moved_[v] = ++clock_; }
  bool hasMoved(uint32_t v) const { return moved_[v] > 0; }

  // Whether edges of v or of later vertices were added.
  bool reach(uint32_t v) {
    while (next_ < count_ && ends_[2 * next_] < v) ++next_;
    return next_ < count_;
  }
  // The minimizer of the edge vw and its error; null if they are not known any more. After reach.
  const S* find(uint32_t v, uint32_t w, S* error) const {
    if (next_ == count_ || ends_[2 * next_] != v || ends_[2 * next_ + 1] != w) return nullptr;
    if (moved_[v] > solved_ || moved_[w] > solved_) return nullptr;
    *error = errors_[next_];
    return &z_[static_cast<size_t>(next_) * static_cast<size_t>(core_.plan.dimension)];
  }

 private:
  const Core<S>& core_;
  Array<uint32_t> moved_;  // per owned vertex: the clock when it last was merged, or 0
  std::vector<S> z_;
  S errors_[kEdgeLanes];
  uint32_t ends_[2 * kEdgeLanes];
  int count_ = 0, next_ = 0;
  uint32_t clock_ = 0, solved_ = 0;
};

}  // namespace tetstream
