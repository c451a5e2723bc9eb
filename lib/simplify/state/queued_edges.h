// simplify/state: edges in order of their errors, and those that wait. Depends on base.
#pragma once

#include <algorithm>
#include <cstdint>

#include "memory.h"

namespace tetstream {

// An edge as it was when it was queued. Stamps of vertices only grow, so that their sum tells
// whether either end has changed since. Errors too large for a float count as its largest.
struct QueuedEdge {
  float error;
  uint32_t u, v, stamp;
  bool operator<(const QueuedEdge& o) const {
    return error != o.error ? error < o.error : u != o.u ? u < o.u : v < o.v;
  }
};

// Of room for edges: 1.25 to a cell inside a mesh, more towards a boundary, and half as many that
// are out of date.
constexpr size_t kQueuedPerCell = 2;

// A heap from the front of an array, and a heap of those that wait from its back: an edge is in
// one of them. Edges that are out of date stay until the room is needed.
class QueuedEdges {
 public:
  explicit QueuedEdges(Account& account) : edges_(account) {}

  void clear() { queued_ = waiting_ = 0; }
  bool empty() const { return queued_ == 0; }

  // `is_current` tells of an edge whether it is up to date.
  template <class IsCurrent>
  void push(const QueuedEdge& edge, IsCurrent is_current) {
    if (queued_ + waiting_ == edges_.size()) makeRoom(is_current);
    edges_[queued_++] = edge;
    std::push_heap(edges_.data(), edges_.data() + queued_, isLater);
  }
  QueuedEdge pop() {
    std::pop_heap(edges_.data(), edges_.data() + queued_, isLater);
    return edges_[--queued_];
  }
  // An edge that was popped just now: its place is free.
  void wait(const QueuedEdge& edge) { edges_[edges_.size() - ++waiting_] = edge; }
  // All that wait are queued again.
  void wakeAll() {
    const QueuedEdge* const end = edges_.data() + edges_.size();
    std::copy(end - waiting_, end, edges_.data() + queued_);
    queued_ += waiting_;
    waiting_ = 0;
    order();
  }

 private:
  static bool isLater(const QueuedEdge& a, const QueuedEdge& b) { return b < a; }
  void order() { std::make_heap(edges_.data(), edges_.data() + queued_, isLater); }

  // Drops what is out of date; where that is little, the array grows.
  // note: it is full, so that those that wait begin where the queued ones end.
  template <class IsCurrent>
  void makeRoom(IsCurrent is_current) {
    const auto is_dropped = [&](const QueuedEdge& edge) { return !is_current(edge); };
    QueuedEdge *const begin = edges_.data(), *const end = begin + edges_.size();
    QueuedEdge *const border = begin + queued_, *const left =
                                                    std::remove_if(border, end, is_dropped);
    queued_ = static_cast<size_t>(std::remove_if(begin, border, is_dropped) - begin);
    waiting_ = static_cast<size_t>(left - border);
    std::move_backward(border, left, end);
    if (queued_ + waiting_ >= edges_.size() / 4 * 3) grow();
    order();
  }
  void grow() {
    const size_t before = edges_.size();
    growArray(before, before / 2 + kLeastRoom, [this](size_t size) { edges_.resize(size); });
    std::move_backward(edges_.data() + (before - waiting_), edges_.data() + before,
                       edges_.data() + edges_.size());
  }

  static constexpr size_t kLeastRoom = 256;
  Array<QueuedEdge> edges_;
  size_t queued_ = 0, waiting_ = 0;
};

}  // namespace tetstream
