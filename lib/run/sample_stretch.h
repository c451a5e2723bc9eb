// run: what a stretch of a stream puts into the bricks that are sampled. Depends on bricks.h,
// sample_rates.h, stream.
#pragma once

#include <vector>

#include "batch.h"
#include "bricks.h"
#include "sample_rates.h"
#include "source.h"

namespace tetstream {

// Of several, each has cache lines of its own: threads fill them side by side.
class alignas(64) SampleStretch {
 public:
  // Vertices are known until `reach` others have been declared behind them. A brick has no more
  // than `most` vertices. Borrows the schema and the bricks.
  SampleStretch(const Schema& schema, const Bricks& bricks, uint64_t reach, uint64_t most,
                const Stretch::Begin& begin);

  // The events, in order.
  void put(const BatchView& batch);
  // What the stretch that follows has found is this one's then, as if that had been put here.
  void append(SampleStretch& next);
  // When nothing more will come.
  void forgetRanks();

  Batch& mesh() { return sample_; }
  const Batch& mesh() const { return sample_; }
  // Of a row of the mesh: its brick; whether it is in a cell of the sample, and in one that is not;
  // whether the stream locks it.
  uint32_t brickOf(size_t row) const { return brick_of_[row]; }
  bool isUsed(size_t row) const { return used_[row]; }
  bool isCut(size_t row) const { return cut_[row]; }
  bool isHeld(size_t row) const { return held_[row]; }
  // Of a cell: when it came.
  uint64_t partOf(size_t cell) const { return part_of_[cell]; }

 private:
  static constexpr uint32_t kNone = Bricks::kNone;

  void addVertex(const BatchView& batch, size_t row);
  void addCell(const BatchView& batch, size_t row);
  uint32_t tableRow(int64_t vertex) const {
    return row_of_[static_cast<uint64_t>(vertex) & (row_of_.size() - 1)];
  }
  uint32_t rowOf(int64_t vertex) const;
  size_t copyVertex(const BatchView& from, size_t row, uint64_t rank, uint32_t brick);
  void copyCell(const BatchView& from, size_t row, const uint32_t rows[4], uint64_t part);
  std::vector<uint32_t> appendVertices(const SampleStretch& next, const BatchView& from);

  const Schema& schema_;
  const Bricks& bricks_;
  const uint64_t reach_, most_;
  const Stretch::Begin begin_;
  Batch sample_;
  std::vector<uint32_t> row_of_;   // of a rank, modulo the size, a power of two; or kNone
  std::vector<uint64_t> rank_of_;  // of a row: they rise
  std::vector<uint32_t> brick_of_;
  std::vector<bool> used_, cut_, held_;
  std::vector<uint8_t> part_of_;  // of a cell
  std::vector<uint64_t> met_;     // vertices in a brick
  uint64_t declared_ = 0;         // vertices, of the stream
  uint64_t next_cell_;
};

}  // namespace tetstream
