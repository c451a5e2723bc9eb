// layout: the front of ordered cells, and the numbers that a stream gives their vertices, where
// there is memory for all vertices. Depends on front_meter.h.
#pragma once

#include "front_meter.h"

namespace tetstream {

// Tells what FrontMeter tells of the same cells, with arrays in place of its lists and its hash.
// The cells are taken twice: from the last to the first, then from the first to the last.
class CellFront {
 public:
  CellFront(uint64_t vertices, Account& account);
  static uint64_t bytesFor(uint64_t vertices) { return vertices * (2 * sizeof(uint32_t) + 1); }

  // Bit j: it is the last one to use its corner j.
  unsigned takeLast(const uint32_t corners[4], uint32_t place);
  void turnRound();
  void takeFirst(const uint32_t corners[4], unsigned last_uses);
  void finish();  // keeps the numbers

  const FrontStatistics& statistics() const { return statistics_; }
  // Of a vertex that a cell uses: vertices count from the first corner that uses them.
  uint32_t number(uint32_t vertex) const { return numbers_[vertex]; }

 private:
  static constexpr uint32_t kNone = 0xffffffffu;
  void introduce(uint32_t vertex);
  void finalize(uint32_t vertex);

  Array<uint32_t> numbers_;  // before the turn: the place of a vertex's last use
  Array<uint32_t> ends_;     // of a vertex: cells of which no other vertex is used later
  Array<uint8_t> is_final_;  // by number
  int64_t introduced_ = 0, active_ = 0, lowest_ = 0, live_cells_ = 0;
  FrontStatistics statistics_;
};

}  // namespace tetstream
