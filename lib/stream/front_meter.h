// stream: measures a stream's front as it passes, and checks its references. Depends on front.h,
// free_rows.h.
#pragma once

#include "batch.h"
#include "free_rows.h"
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

  // What put does, in steps, for those who look at the front in between: declare the batch's
  // vertices; for each cell, add it, finalize what it carries, and note; then the explicit
  // finalizations, and note.
  void declare(const BatchView& batch);
  uint32_t addCell(const int64_t corners[4]);  // the cell's row, until it touches no active vertex
  uint32_t finalize(int64_t vertex);           // the row that the vertex had in front()
  void note();
  const Front& front() const { return front_; }
  // Rows are below these; they are used again.
  size_t cellRows() const { return cell_rows_.rows(); }
  size_t vertexRows() const { return vertex_rows_.rows(); }
  bool isLive(uint32_t cell) const { return pending_[cell] != 0; }

 private:
  // Cells of one vertex: with the number of the block before as long as a cache line.
  static constexpr uint32_t kBlockCells = 15;
  struct Block {
    uint32_t before, cells[kBlockCells];
  };
  static constexpr uint32_t kNoBlock = 0xffffffffu;
  struct Vertex {
    uint32_t last_block, in_last;
  };

  void introduceUpTo(uint64_t vertex);
  void findCorners(const int64_t corners[4], uint32_t slots[4]);
  void use(Vertex& vertex, uint32_t cell);
  void settle(uint32_t cell);

  Front front_;
  FreeRows vertex_rows_, cell_rows_, block_rows_;
  Array<Vertex> vertices_;
  Array<Block> blocks_;
  Array<uint8_t> pending_;  // per cell: corners whose vertices are not final
  uint64_t declared_ = 0, cells_seen_ = 0;
  int64_t live_cells_ = 0;
  FrontStatistics statistics_;
};

}  // namespace tetstream
