// run: a sample of a long stream, to learn from before it is simplified: how its cells should be
// spread over it. Depends on stream, simplify.
//
// The mesh's box is cut into bricks of some thousand cells, and of these about as many are taken,
// by a hash of their places, as a sample holds; their vertices on the cuts are locked. Simplified
// with a common bound, each brick shows how much of what lies there should be left.
#pragma once

#include <unordered_map>

#include "batch.h"
#include "options.h"
#include "pilot.h"

namespace tetstream {

class Sampler {
 public:
  // Whether a stream tells what a sampler must know, its count, box and span, and has a field: the
  // shape of the boundary alone asks for many cells where few samples are.
  static bool serves(const Schema& schema);
  explicit Sampler(const Schema& schema);

  // The events of the whole stream, in order.
  void put(const BatchView& batch);

  // Then simplifies the sample, and tells what comes of it for the whole stream: not known() where
  // nothing was met, or nothing could be simplified.
  Pilot fly(const SimplifyOptions& options);

  // For fly, and to be looked at. The sample as a stream of one batch:
  Schema schema() const;
  BatchView mesh();
  // All vertices that are left of it.
  void countSurvivors(const BatchView& simplified);

 private:
  static constexpr size_t kParts = 64;  // of the stream
  struct Brick {
    int64_t cells[kParts] = {};  // that were sampled, by when they came
    int64_t locked = 0, free = 0, survivors = 0;
  };
  static constexpr uint32_t kNone = 0xffffffffu;

  uint32_t brickAt(const double place[3]);
  uint32_t sampledBrick(uint64_t at);
  void placeOf(const void* positions, size_t row, double place[3]) const;
  void addVertex(const BatchView& batch, size_t row);
  uint32_t tableRow(int64_t vertex) const {
    return row_of_[static_cast<uint64_t>(vertex) & (row_of_.size() - 1)];
  }
  uint32_t rowOf(int64_t vertex) const;
  void addCell(const BatchView& batch, size_t row);
  double ratioFor(double left) const;
  Pilot pilot(double bound, double ratio) const;

  Schema schema_;
  Batch sample_;
  double low_[3], brick_size_;
  uint64_t bricks_[3], one_in_;
  std::vector<uint32_t> row_of_;   // of a rank, modulo the size, a power of two; or kNone
  std::vector<uint64_t> rank_of_;  // of a row
  std::vector<uint32_t> brick_of_;
  std::vector<bool> used_, cut_;                    // in a cell of the sample, in one that is not
  std::unordered_map<uint64_t, uint32_t> sampled_;  // bricks, by their place
  std::vector<Brick> brick_;
  uint64_t last_place_ = ~uint64_t{0};  // of a brick, and which it is; at first none
  uint32_t last_brick_ = kNone;
  uint64_t cells_seen_ = 0;
};

}  // namespace tetstream
