#include "lane.h"

#include <algorithm>
#include <iterator>

namespace tetstream {

template <class S>
void Lane<S>::begin(const Goal& goal, double unit) {
  sweep().begin(goal, unit);
  if (!core_.flips()) return;
  if (!reshaper_) reshaper_.emplace(core_, sweep().patch(), sweep().tally(), account_);
  if (core_.tracer && core_.tracer->tracesPoints()) reshaper_->observe(core_.tracer);
}

// Whether nothing but the patch, which is not stored, knows what was done to it: integers of
// vertices, cell data, curves, labelled faces and what is traced follow each change.
template <class S>
bool Lane<S>::canForget(const Tally& before) const {
  const Tally& now = sweep_->state().tally;
  if (sweep_->isStored()) return false;
  if (now.collapses == before.collapses && now.flips == before.flips) return true;
  const Plan& plan = core_.plan;
  return plan.picks == 0 && plan.cell_means == 0 && plan.cell_picks == 0 && !core_.tracer &&
         core_.window.curves.empty() && !core_.window.faces.anyPlaced();
}

// Without the patch and the arrays that it took.
template <class S>
void Lane<S>::startAnew(const typename PatchSweep<S>::State& state) {
  const typename PatchSweep<S>::State kept = state;
  reshaper_.reset();
  sweep_.emplace(core_, account_, kept);
  begin(kept.goal, kept.unit);
}

// Of the cells those with one of the vertices.
template <class S>
std::vector<uint32_t> Lane<S>::touching(const uint32_t* owned, size_t owned_count,
                                        const uint32_t* cells, size_t cell_count) const {
  std::vector<uint32_t> sorted(owned, owned + owned_count), found;
  std::sort(sorted.begin(), sorted.end());
  const auto isOwned = [&](uint32_t v) {
    return std::binary_search(sorted.begin(), sorted.end(), v);
  };
  std::copy_if(cells, cells + cell_count, std::back_inserter(found), [&](uint32_t cell) {
    const uint32_t* const corners = core_.window.mesh.corners(cell);
    return core_.window.mesh.isLive(cell) && std::any_of(corners, corners + 4, isOwned);
  });
  return found;
}

template class Lane<float>;
template class Lane<double>;

}  // namespace tetstream
