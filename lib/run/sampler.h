// run: a sample of a long stream, to learn from before it is simplified: how its cells should be
// spread over it. Depends on stream, simplify.
//
// Some bricks with some thousand cells each are taken out of the mesh; their vertices on the cuts
// are locked. Simplified with a common bound, each brick shows how much of what lies there should
// be left. The stream is read twice: for the bricks, then for what they hold.
#pragma once

#include <vector>

#include "batch.h"
#include "bricks.h"
#include "options.h"
#include "pilot.h"

namespace tetstream {

class Sampler {
 public:
  // Whether a stream tells what a sampler must know, its counts, box and span, and has a field: the
  // shape of the boundary alone asks for many cells where few samples are. And whether a memory
  // budget has room for a sample of some size, with all that it takes.
  static bool serves(const Schema& schema, const SimplifyOptions& options);
  // Whether what a sample tells is likely to lower the errors of the run.
  static bool pays(const Schema& schema, const SimplifyOptions& options);
  Sampler(const Schema& schema, const SimplifyOptions& options);

  // The events of the whole stream, in order: first all to be counted; then, when the bricks are
  // taken, all to be sampled.
  void count(const BatchView& batch);
  void takeBricks();
  void put(const BatchView& batch);

  // Then simplifies the sample, and tells how what is left of it is spread over the whole stream:
  // not known() where too little was met, or nothing could be simplified.
  Pilot fly();

  // For fly, and to be looked at, when all is put. The sample as a stream of one batch:
  Schema schema() const;
  BatchView mesh();
  // What the sample leaves of a memory budget, for the window that simplifies it.
  int64_t windowBytes() const;
  // All vertices that are left of it.
  void countSurvivors(const BatchView& simplified);

 private:
  static constexpr size_t kParts = 64;  // of the stream
  struct Brick {
    int64_t cells[kParts] = {};  // that were sampled, by when they came
    int64_t locked = 0, free = 0, survivors = 0;
    uint64_t vertices = 0;
  };
  static constexpr uint32_t kNone = Bricks::kNone;

  void placeOf(const void* positions, size_t row, double place[3]) const;
  void addVertex(const BatchView& batch, size_t row);
  uint32_t tableRow(int64_t vertex) const {
    return row_of_[static_cast<uint64_t>(vertex) & (row_of_.size() - 1)];
  }
  uint32_t rowOf(int64_t vertex) const;
  void addCell(const BatchView& batch, size_t row);
  double ratioFor(double left) const;
  static std::vector<double> ratesFrom(const double* left, const double* met, size_t bricks);
  Pilot pilot(double ratio) const;

  Schema schema_;
  SimplifyOptions options_;
  Batch sample_;
  double wanted_;      // cells
  uint64_t most_ = 0;  // vertices of a brick
  Bricks bricks_;
  uint64_t rows_;                  // of the table
  std::vector<uint32_t> row_of_;   // of a rank, modulo the size, a power of two; or kNone
  std::vector<uint64_t> rank_of_;  // of a row
  std::vector<uint32_t> brick_of_;
  std::vector<bool> used_, cut_;  // in a cell of the sample, in one that is not
  std::vector<Brick> brick_;      // taken when all is counted
  uint64_t cells_seen_ = 0;
};

}  // namespace tetstream
