// simplify: what becomes known when a vertex is final: boundary, folds, non-manifold places,
// interfaces. Depends on metric.h, sheets.h.
#pragma once

#include "link.h"
#include "metric.h"
#include "sheets.h"

namespace tetstream {

// A final vertex has its whole star in the window (paper, section 4: only then is it off the
// stream boundary). Whether its link is closed, so that it lies inside the domain, is told by a sum
// over its cells in one pass over the window; only the stars of the others, and of those with cells
// of several regions or labelled faces, are looked at. Their faces on the boundary, on interfaces
// and those that are labelled are found and counted once, by the first of their vertices that
// becomes final; what must not move is locked.
template <class S>
class Resolver {
 public:
  Resolver(Core<S>& core, Metric<S>& metric, Account& account)
      : core_(core),
        metric_(metric),
        sheets_(core, metric),
        star_(account),
        corners_(account, 256),
        open_(account),
        next_{Array<uint32_t>(account, 256), Array<uint32_t>(account, 256)},
        edges_(account, 256) {}

  // The window's cells from `first_new` on are new: they add their quadrics. All cells of these
  // vertices are there. Returns the cells of the front: those that touch a vertex not yet final.
  int64_t resolve(uint32_t first_new, const uint32_t* vertices, size_t count);

 private:
  int64_t takeNew(uint32_t first);
  int64_t sumLinks(uint32_t first, uint32_t end);
  void addToLinks(uint32_t cell, const unsigned flags[4]);
  void addToRegions(uint32_t cell, const unsigned flags[4], const CellLabels& labels);
  template <class Visit>
  void forPlaced(uint32_t first, uint32_t end, Visit visit) const;
  size_t listStars(size_t count);
  void resolveOpen(uint32_t v, const uint32_t* corners, size_t count);
  void resolveFaces(uint32_t v);
  void addFace(uint32_t v, uint32_t a, uint32_t b, SheetFace kind, const int64_t* label);
  const int64_t* labelOf(uint32_t cell, uint32_t other, uint32_t v, uint32_t a, uint32_t b);
  bool isDisk(const std::vector<uint64_t>& boundary);
  void lockFold(uint32_t a, uint32_t b);
  void lockNonManifold(uint32_t v);

  Core<S>& core_;
  Metric<S>& metric_;
  Sheets<S> sheets_;
  Star star_;
  Array<uint32_t> corners_;  // of the stars that are looked at
  Array<uint32_t> open_;     // vertices whose link is not closed, or of several labels
  Array<uint32_t> next_[2];  // of each star among the corners, by halves; in the end, its end
  struct LinkEdge {
    uint64_t key;  // directed, as (low, high, direction)
    uint32_t cell;
  };
  Array<LinkEdge> edges_;
  std::vector<uint64_t> boundary_, ends_;
};

}  // namespace tetstream
