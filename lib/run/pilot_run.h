// run: what is found out about a stream before it is simplified. Depends on reading.h, sampler.h.
#pragma once

#include <optional>
#include <vector>

#include "reading.h"
#include "sampler.h"

namespace tetstream {

// A mesh that is larger than its window is read before, where that is worth its time: all of it is
// simplified in core, to nowhere, or of a longer one a sample.
class PilotRun {
 public:
  // All is borrowed. `tell` gets the progress, as a share of the whole run.
  PilotRun(const RunOptions& options, const Tasks& tasks, Ordering& stream, ProgressFunction tell)
      : options_(options), tasks_(tasks), stream_(stream), tell_(std::move(tell)) {}

  // Nothing where it is not worth it, or the stream can be read but once.
  std::optional<Pilot> run();
  double share() const { return share_; }  // of the time, that it took

 private:
  std::optional<Pilot> simplifyAll();
  std::optional<Pilot> sample();
  std::optional<Pilot> sampleBy(size_t threads);
  std::vector<Stretch> stretchesOf(Part part, size_t most, uint64_t before);
  template <class Use>
  void read(std::vector<Stretch>& stretches, double share_before, Use use);
  void tellSampling(double share_before, double part, int64_t cells);

  const RunOptions& options_;
  const Tasks& tasks_;
  Ordering& stream_;
  ProgressFunction tell_;
  double share_ = 0, told_ = 0;
};

}  // namespace tetstream
