// simplify/intake: what becomes known when a vertex is final: boundary, folds, non-manifold places,
// interfaces. Depends on balance_sample.h, link_border.h, metric.h, sheets.h.
#pragma once

#include <vector>

#include "angles.h"
#include "balance_sample.h"
#include "link_border.h"
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
        angles_(core),
        sheets_(core),
        corners_(account, 256),
        open_(account),
        edges_(account) {
    while (parts_.size() < core.mostParts()) {
      parts_.emplace_back(account);
      next_.emplace_back(account, 256);
    }
  }

  // The window's cells from `first_new` on are new: they add their quadrics; older ones may have
  // changed. All cells of these vertices are there. Returns the cells of the front: those that
  // touch a vertex not yet final.
  int64_t resolve(uint32_t first_new, const uint32_t* vertices, size_t count);

 private:
  int64_t takeNew(uint32_t first);
  int64_t sumLinks(uint32_t first, uint32_t end, uint32_t first_new);
  void addToLinks(uint32_t cell, const unsigned flags[4]);
  void tellCorners(uint32_t cell, const unsigned flags[4], const CellLabels& labels);
  template <class Visit>
  void forPlaced(uint32_t first, uint32_t end, Visit visit) const;
  size_t listStars(size_t count);
  // The corners of a star that was listed.
  struct Corners {
    const uint32_t* first;
    size_t count;
  };
  Corners cornersOf(size_t place) const {
    const Array<uint32_t>& end = next_[core_.parts() - 1];
    const uint32_t begin = place > 0 ? end[place - 1] : 0;
    return {corners_.data() + begin, end[place] - begin};
  }
  void gather(Corners corners, Star& star) const;
  // What is known of a vertex before the boundary is added to: whether its link is that of a vertex
  // with nothing but faces of the boundary, where they lie, and whether they make one fan, or a
  // rim.
  struct Found {
    size_t begin, count;
    bool is_plain, is_disk, folds;
  };
  struct Part {
    explicit Part(Account& account) : star(account), border(account) {}
    Star star;
    LinkBorder border;
    std::vector<uint64_t> faces;  // as edges of the links
    std::vector<Found> found;
  };
  Star& star() { return parts_[0].star; }  // that the caller's thread looks at
  void findFaces(const uint32_t* vertices, size_t begin, size_t end, Part& part) const;
  void resolveListed(const uint32_t* vertices, size_t count);
  void addFound(uint32_t v, const Found& found, const Part& part);
  void resolveOpen(uint32_t v, Corners corners);
  void finishFaces(uint32_t v, bool is_disk, bool folds);
  bool foldsAt(uint32_t v, const std::vector<uint64_t>& faces) const;
  void resolveFaces(uint32_t v);
  struct LinkEdge {
    uint64_t key;  // directed, as (low, high, direction)
    uint32_t cell;
  };
  template <class Visit>
  void forLinkEdges(Visit visit);
  void pickSamples(const uint32_t* vertices, size_t count);
  void balance(size_t open);
  bool isBalanced() const;
  template <class Visit>
  void forStarsOf(const std::vector<uint32_t>& vertices, Visit visit);
  using SampledFace = typename BalanceSample<S>::Face;
  bool listSheet(SheetFace kind, std::vector<SampledFace>& faces);
  void sampleSheet(const std::vector<uint32_t>& vertices, SheetFace kind, BalanceSample<S>& sample);
  template <class Visit>
  void forSheetsOf(const std::vector<uint32_t>& vertices, SheetFace kind, Visit visit);
  void addFace(uint32_t v, uint32_t a, uint32_t b, SheetFace kind, const int64_t* label);
  const int64_t* labelOf(const LinkEdge* edge, size_t cells, uint32_t v, uint32_t a, uint32_t b);
  void lockFold(uint32_t a, uint32_t b);
  void lockNonManifold(uint32_t v);

  Core<S>& core_;
  Metric<S>& metric_;
  Angles<S> angles_;
  Sheets<S> sheets_;
  std::vector<Part> parts_;
  Array<uint32_t> corners_;  // of the stars that are looked at
  Array<uint32_t> open_;     // vertices whose link is not closed, or of several labels
  // Of each star among the corners, by parts of the cells: where the next one goes. In the end that
  // of the last part is its end.
  std::vector<Array<uint32_t>> next_;
  Array<LinkEdge> edges_;
  std::vector<uint64_t> boundary_;
  using Sampled = typename BalanceSample<S>::Group;
  Sampled sampled_[3];  // of the boundary, of interfaces, inside
};

}  // namespace tetstream
