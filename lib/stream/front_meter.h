// stream: measures a stream's front as it passes, and checks its references. Depends on front.h.
#pragma once

#include "batch.h"
#include "front.h"

namespace tetstream {

struct FrontStatistics {
  int64_t width = 0;  // vertices active at once, at most
  int64_t span = 0;   // highest minus lowest active vertex + 1, at most
  int64_t cells = 0;  // cells read that touch a vertex not yet finalized, at most
};

// Memory is O(front). Vertices count from the first cell that uses them or a later one, as every
// consumer introduces them. Throws kBadData at the first reference to a vertex that is unknown or
// already final, and at a cell with a repeated vertex.
class FrontMeter {
 public:
  explicit FrontMeter(Account& account);
  void put(const BatchView& batch);
  const FrontStatistics& statistics() const { return statistics_; }
  uint64_t cellsSeen() const { return cells_seen_; }

 private:
  static constexpr uint32_t kNone = 0xffffffffu;
  void introduceUpTo(uint64_t vertex);
  void addCell(const int64_t corners[4]);
  void finalize(int64_t vertex);
  uint32_t takeVertex();
  uint32_t takeCell();

  Front front_;
  // A vertex holds the head of the list of its cells' corners; corner 4 * cell + j links on. Free
  // vertices and cells are chained through the same members.
  Array<uint32_t> vertex_head_, corner_next_;
  Array<uint8_t> pending_;  // per cell: corners whose vertices are not final
  uint32_t vertex_free_ = kNone, cell_free_ = kNone;
  uint64_t declared_ = 0, cells_seen_ = 0;
  int64_t live_cells_ = 0;
  FrontStatistics statistics_;
};

}  // namespace tetstream
