// simplify: whether an edge may be collapsed to a point, and doing it. Depends on core.h, mesh.
#pragma once

#include "core.h"
#include "link.h"
#include "orient.h"

namespace tetstream {

// Told of every collapse, in order: vertex v was merged into u, which then has its new values.
// Slots are those of the window until the next pack. A seam for vertex maps and logs.
class CollapseObserver {
 public:
  virtual ~CollapseObserver() = default;
  virtual void collapsed(uint32_t u, uint32_t v, double error) = 0;
};

enum class Outcome { kDone, kLocked, kTooMany, kTopology, kOrientation, kNotFinite };

template <class S>
class Collapser {
 public:
  Collapser(Core<S>& core, Account& account);

  void observe(CollapseObserver* observer) { observer_ = observer; }

  // Merges v into u at z, normalised and relative to the edge's midpoint, if the result is legal:
  // both vertices free; topology kept; every cell round the merged vertex strictly oriented as
  // before, decided exactly on the values as they will be written, and none so thin as kLeastShape
  // unless one was as thin before; no fewer than `least_cells`
  // cells left in the window. Counts what happened in the report.
  Outcome collapse(uint32_t u, uint32_t v, const S* z, S error, int64_t least_cells);

  // z of the ends and of the midpoint, which minimizers are compared with.
  void endOf(uint32_t u, uint32_t v, bool at_v, S* z) const;

 private:
  Outcome test(uint32_t u, uint32_t v, int64_t least_cells);
  void placeAt(uint32_t u, uint32_t v, const S* z);
  bool keepsOrientation(uint32_t other, const Star& star, double* worst);
  bool lanesPositive(const StarCell* const cells[], int count, double* worst);
  double worstShape(uint32_t centre, const Star& star);
  void gatherLanes(const StarCell* const cells[], int count, TriangleLanes& lanes) const;
  void interpolateCarried(uint32_t u, uint32_t v);
  void pickNearest(uint32_t u, uint32_t v);
  void handOverCellData(uint32_t v);
  void mergeInto(uint32_t u, uint32_t v, S error);

  Core<S>& core_;
  LinkCondition link_;
  Star around_u_, around_v_;
  std::vector<S> merged_;  // values of the merged vertex
  CollapseObserver* observer_ = nullptr;
};

}  // namespace tetstream
