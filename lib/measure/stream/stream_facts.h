// measure/stream: what a stream is like, in memory of the size of its front. Depends on
// layout_diagram.h, face_labels.h.
#pragma once

#include <vector>

#include "face_labels.h"
#include "layout_diagram.h"

namespace tetstream {

// Counts, box, front, lifetimes and labelled faces of the events that pass.
class StreamFacts {
 public:
  explicit StreamFacts(const Schema& schema);
  void put(const BatchView& batch);
  void finish();
  // After finish:
  Schema schema() const;  // the stream's, with everything known
  const DiagramFigures& figures() const { return diagram_.figures(); }
  const std::vector<int64_t>& notFinite() const { return not_finite_; }  // values of each field
  const FaceLabels& faceLabels() const { return face_labels_; }          // without areas

 private:
  void growBox(const BatchView& batch);

  Schema schema_;
  LayoutDiagram diagram_;  // of a single place
  FaceLabels face_labels_;
  std::vector<int64_t> not_finite_;
  uint64_t vertices_ = 0;
};

}  // namespace tetstream
