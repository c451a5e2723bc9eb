// simplify/intake: what of the interfaces of regions and of the curves in them meets at a vertex.
// Depends on sheet_quadrics.h.
#pragma once

#include "sheet_quadrics.h"

namespace tetstream {

// The faces of the sheets round a vertex whose star is known, each as the edge opposite in the
// link: finds the curves through the vertex, and whether it may move (mesh/strata.h).
template <class S>
class Sheets {
 public:
  explicit Sheets(Core<S>& core);

  void clear() { faces_.clear(); }
  // `label`: of a labelled face, or null.
  void add(uint32_t a, uint32_t b, SheetFace kind, const int64_t* label) {
    core_.exact_curves |= label != nullptr;
    faces_.push_back({a, b, label != nullptr, kind, label ? *label : 0});
  }
  // Whether there can be more than the boundary, which is looked at by others but for its folds.
  bool wanted() const {
    return !faces_.empty() && (!core_.region_picks.empty() || core_.exact_curves);
  }
  // Marks the edges of curves at v that no end resolved before has told of; returns whether v is
  // inside a sheet or on a single curve, no corner. With `folds`, folds of the boundary are
  // curves, which make no corner.
  bool classify(uint32_t v, bool folds);

 private:
  struct Face {
    uint32_t a, b;
    bool labelled;
    SheetFace kind;
    int64_t label;
    uint32_t other(uint32_t x) const { return x == a ? b : a; }
  };
  struct Use {  // of a link's vertex by a face
    uint32_t vertex, face;
  };

  const Use* usesOf(uint32_t vertex) const;
  bool isCurve(uint32_t v, uint32_t a, const Use* uses, size_t degree, bool folds) const;
  bool divides(const Use* uses, size_t degree) const;
  bool isRidge(uint32_t v, uint32_t a, const Face& one, const Face& other, bool folds) const;
  size_t walk(uint32_t from, uint32_t face, uint32_t* end) const;
  bool isWhole(const std::vector<uint32_t>& nodes) const;

  Core<S>& core_;
  bool asks_;            // for ridges
  double least_cosine_;  // of one, as in folds.h
  std::vector<Face> faces_;
  std::vector<Use> uses_;        // sorted by vertex
  std::vector<uint32_t> nodes_;  // other ends of the curves' edges at v
};

}  // namespace tetstream
