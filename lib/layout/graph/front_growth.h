// layout/graph: numbers the vertices of a graph so that few are active at once. Depends on
// laplacian.h.
//
// A sequence of vertices, each of which is closed: its neighbours and itself become active where
// they were not, then it is not active any more. That is a stream read backwards: what is closed
// first has the highest rank.
#pragma once

#include "laplacian.h"

namespace tetstream {

// Closes one vertex after the other, always the one with the least guide + number of vertices that
// become active by it, of those that are active or next to an active one (after Sloan 1989; with a
// spectral guide: Kumfert and Pothen 1997). Vertices by which nothing becomes active go first.
class FrontGrowth {
 public:
  FrontGrowth(const GraphView& graph, Account& account);
  // Returns the most vertices that are active at once.
  uint32_t run(const float* guide, uint32_t* sequence);

 private:
  void open(uint32_t vertex);
  void offer(uint32_t vertex);
  uint32_t takeLeast();
  void rise(uint32_t place);
  void sink(uint32_t place);
  bool isBefore(uint32_t a, uint32_t b) const {
    return key_[a] != key_[b] ? key_[a] < key_[b] : a < b;
  }

  const GraphView graph_;
  const float* guide_ = nullptr;
  Array<uint32_t> closed_by_;  // how many of its neighbours and itself are not active yet
  Array<float> key_;
  Array<uint32_t> heap_, place_;  // vertices; where each is: kNowhere, kClosed
  Array<uint8_t> opened_;
  uint32_t heap_size_ = 0, active_ = 0;
};

// The same figure of a given sequence. layer[v]: how far along it v is closed, where closing as
// many vertices as are active counts as 1.
uint32_t findLayers(const GraphView& graph, const uint32_t* sequence, Account& account,
                    float* layer);

}  // namespace tetstream
