// run: a sample of a long stream, to learn from before it is simplified: how its cells should be
// spread over it. Depends on stream, simplify.
//
// Some bricks with some thousand cells each are taken out of the mesh; their vertices on the cuts
// are locked. Simplified with a common bound, each brick shows how much of what lies there should
// be left. The stream is read twice: for the bricks, then for what they hold.
#pragma once

#include <deque>
#include <vector>

#include "bricks.h"
#include "options.h"
#include "pilot.h"
#include "sample_rates.h"
#include "sample_stretch.h"

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
  Sampler(const Sampler&) = delete;
  Sampler& operator=(const Sampler&) = delete;

  // The events of the whole stream, in order: first all to be counted; then, when the bricks are
  // taken, all to be sampled. Either of them in stretches, too, each by a thread of its own; what
  // comes of it is the same.
  void countInStretches(size_t stretches);
  void count(const BatchView& batch, size_t stretch = 0);
  void takeBricks(const std::vector<Stretch::Begin>& stretches = {{}});
  void put(const BatchView& batch, size_t stretch = 0) { stretches_[stretch].put(batch); }
  // Each stretch knows vertices of its own: so many do not take too much for that.
  size_t mostStretches() const;
  // Vertices that must come again before a stretch's own, to be sampled with it.
  uint64_t reach() const { return reach_; }

  // Then simplifies the sample, and tells how what is left of it is spread over the whole stream:
  // not known() where too little was met, or nothing could be simplified.
  Pilot simplify();

  // What that works with, once all is put: the sample as a stream of one batch,
  BatchView mesh();
  Schema schema() const;  // of that
  // What the sample leaves of a memory budget, for the window that simplifies it.
  int64_t windowBytes() const;
  // All vertices that are left of it.
  void countSurvivors(const BatchView& simplified);

 private:
  struct Brick {
    int64_t cells[kStreamParts] = {};     // that were sampled, by when they came
    int64_t cut = 0, held = 0, free = 0;  // vertices: on its cuts, locked by the stream, others
    int64_t survivors = 0;
    BrickLeft left() const;
  };

  void countBricks();
  double ratioFor(double left) const;
  Pilot pilot(double ratio) const;

  const Schema schema_;
  const SimplifyOptions options_;
  double wanted_;               // cells
  uint64_t reach_;              // vertices
  std::vector<Bricks> counts_;  // of each stretch; in the end the first has all, and the bricks
  std::deque<SampleStretch> stretches_;  // in the end one
  std::vector<Brick> brick_;
};

}  // namespace tetstream
