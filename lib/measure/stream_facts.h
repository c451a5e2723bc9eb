// measure: what a stream is like, in memory of the size of its front. Depends on layout_diagram.h.
#pragma once

#include "layout_diagram.h"

namespace tetstream {

// Counts, box, front and lifetimes of the events that pass.
class StreamFacts {
 public:
  explicit StreamFacts(const Schema& schema);
  void put(const BatchView& batch);
  void finish();
  // After finish:
  Schema schema() const;  // the stream's, with everything known
  const DiagramFigures& figures() const { return diagram_.figures(); }

 private:
  void growBox(const BatchView& batch);

  Schema schema_;
  LayoutDiagram diagram_;  // of a single place
  uint64_t vertices_ = 0;
};

}  // namespace tetstream
