// measure: what a stream is like, in memory of the size of its front. Depends on stream.
#pragma once

#include "front_meter.h"

namespace tetstream {

// Counts, box and front of the events that pass.
class StreamFacts {
 public:
  explicit StreamFacts(const Schema& schema);
  void put(const BatchView& batch);
  Schema schema() const;  // the stream's, with everything known

 private:
  void growBox(const BatchView& batch);

  Schema schema_;
  Account account_;
  FrontMeter meter_;
  uint64_t vertices_ = 0;
};

}  // namespace tetstream
