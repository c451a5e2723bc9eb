// measure/stream: labelled faces by their labels. Depends on base.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

namespace tetstream {

struct FaceLabelFigures {
  int64_t faces = 0;
  double area = 0;
};

// Labels beyond kMostLabels number the faces: they are no longer told apart, and none is told.
class FaceLabels {
 public:
  static constexpr size_t kMostLabels = 65536;

  void add(int64_t label, double area) {
    ++faces_;
    if (faces_numbered_) return;
    FaceLabelFigures& figures = labels_[label];
    ++figures.faces;
    figures.area += area;
    faces_numbered_ = labels_.size() > kMostLabels;
    if (faces_numbered_) labels_.clear();
  }
  int64_t faces() const { return faces_; }
  const std::map<int64_t, FaceLabelFigures>& labels() const { return labels_; }

 private:
  std::map<int64_t, FaceLabelFigures> labels_;
  int64_t faces_ = 0;
  bool faces_numbered_ = false;
};

}  // namespace tetstream
