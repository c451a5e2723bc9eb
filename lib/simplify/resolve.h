// simplify: what becomes known when a vertex is final: boundary, folds, non-manifold places,
// interfaces. Depends on metric.h, regions.h.
#pragma once

#include "link.h"
#include "metric.h"
#include "regions.h"

namespace tetstream {

// A final vertex has its whole star in the window (paper, section 4: only then is it off the
// stream boundary). Its boundary faces are found and counted once, by the first of their vertices
// that becomes final; what must not move is locked.
template <class S>
class Resolver {
 public:
  Resolver(Core<S>& core, Metric<S>& metric, Regions<S>& regions, Account& account)
      : core_(core), metric_(metric), regions_(regions), star_(account), edges_(account, 256) {}

  void resolve(const uint32_t* vertices, size_t count);

 private:
  void resolve(uint32_t v);
  void resolveBoundary(uint32_t v);
  bool isDisk(const std::vector<uint64_t>& boundary);
  void lockFold(uint32_t a, uint32_t b);
  void lockNonManifold(uint32_t v);

  Core<S>& core_;
  Metric<S>& metric_;
  Regions<S>& regions_;
  Star star_;
  Array<uint64_t> edges_;  // of the link, directed, as (low, high, direction)
  std::vector<uint64_t> boundary_, ends_;
};

}  // namespace tetstream
