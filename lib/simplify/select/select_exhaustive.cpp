// simplify/select: every edge in order of its error. See select.h.
#include <algorithm>
#include <array>

#include "select.h"

namespace tetstream {
namespace {

// Edges listed at once: bounds the memory that this step takes beside the window's.
constexpr size_t kEdgesAtOnce = 16384;

template <class Mesh>
class ExhaustiveSelector final : public Selector {
 public:
  using S = typename Mesh::Scalar;

  ExhaustiveSelector(Core<S>& core, Collapser<Mesh>& collapser)
      : core_(core),
        collapser_(collapser),
        mesh_(collapser.mesh()),
        room_(static_cast<size_t>(core.plan.dimension)) {
    for (auto& z : z_) z.resize(room_);
  }

  // A part of the window at a time, and of its edges the better half: the errors of the others
  // change with it.
  void decimate(const Goal& goal, const std::function<void()>& tick) override {
    for (bool all = false; !reached(goal);) {
      bool moved = false;
      for (uint32_t cell = 0; cell < mesh_.cellEnd() && !reached(goal);) {
        tick();
        cell = listEdges(cell);
        const size_t count = all ? edges_.size() : (edges_.size() + 1) / 2;
        for (size_t i = 0; i < count && !reached(goal); ++i)
          moved = tryEdge(edges_[i].u, edges_[i].v, goal) || moved;
      }
      if (!moved && all) return;
      all = !moved;
    }
  }

 private:
  struct Edge {
    S error;
    uint32_t u, v;
    bool operator<(const Edge& o) const {
      return error != o.error ? error < o.error : u != o.u ? u < o.u : v < o.v;
    }
  };

  bool reached(const Goal& goal) const {
    return mesh_.liveCells() <= goal.cells || collapser_.errorReached();
  }
  uint32_t listEdges(uint32_t first_cell);
  S minimize(uint32_t u, uint32_t v, S* z);
  bool tryEdge(uint32_t u, uint32_t v, const Goal& goal);

  Core<S>& core_;
  Collapser<Mesh>& collapser_;
  Mesh& mesh_;
  size_t room_;
  std::vector<uint64_t> pairs_;
  std::vector<Edge> edges_;
  std::array<std::vector<S>, 4> z_;
};

template <class Mesh>
typename Mesh::Scalar ExhaustiveSelector<Mesh>::minimize(uint32_t u, uint32_t v, S* z) {
  const auto solve =
      followsPaper(core_.options.mode) ? core_.kernels.minimizeEdge : core_.kernels.solveEdge;
  return solve(mesh_.quadric(u), mesh_.values(u), mesh_.quadric(v), mesh_.values(v),
               core_.scale.data(), core_.plan.dimension, z);
}

// The edges of the cells from `first_cell` on, in order of their error; returns the first cell that
// was left for the next time.
template <class Mesh>
uint32_t ExhaustiveSelector<Mesh>::listEdges(uint32_t first_cell) {
  uint32_t cell = first_cell;
  pairs_.clear();
  for (; cell < mesh_.cellEnd() && pairs_.size() < kEdgesAtOnce; ++cell) {
    if (!mesh_.isLive(cell)) continue;
    for (uint32_t i = 0; i < 4; ++i)
      for (uint32_t j = i + 1; j < 4; ++j) {
        const uint32_t u = mesh_.vertexOf(cell, i), v = mesh_.vertexOf(cell, j);
        if (mesh_.isFree(u) && mesh_.isFree(v))
          pairs_.push_back(uint64_t{std::min(u, v)} << 32 | std::max(u, v));
      }
  }
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  edges_.clear();
  for (uint64_t pair : pairs_) {
    Edge e{0, static_cast<uint32_t>(pair >> 32), static_cast<uint32_t>(pair)};
    e.error = minimize(e.u, e.v, z_[0].data());
    if (std::isfinite(e.error)) edges_.push_back(e);
  }
  std::sort(edges_.begin(), edges_.end());
  return cell;
}

// The minimizer first, then the midpoint and the ends by their errors.
template <class Mesh>
bool ExhaustiveSelector<Mesh>::tryEdge(uint32_t u, uint32_t v, const Goal& goal) {
  if (!mesh_.isFree(u) || !mesh_.isFree(v)) return false;
  std::array<S, 4> error;
  error[0] = minimize(u, v, z_[0].data());
  std::fill(z_[1].begin(), z_[1].end(), S(0));
  collapser_.endOf(u, v, false, z_[2].data());
  collapser_.endOf(u, v, true, z_[3].data());
  for (size_t i = 1; i < 4; ++i)
    error[i] =
        core_.kernels.errorAt(mesh_.quadric(u), mesh_.values(u), mesh_.quadric(v), mesh_.values(v),
                              core_.scale.data(), core_.plan.dimension, z_[i].data());
  std::array<size_t, 4> order = {0, 1, 2, 3};
  std::sort(order.begin(), order.end(),
            [&](size_t a, size_t b) { return error[a] != error[b] ? error[a] < error[b] : a < b; });
  for (size_t i : order) {
    const Outcome outcome = collapser_.collapse(u, v, z_[i].data(), error[i], goal.least_cells);
    if (outcome == Outcome::kDone) return true;
    if (!mayFitElsewhere(outcome)) return false;
  }
  return false;
}

}  // namespace

template <class Mesh>
std::unique_ptr<Selector> makeExhaustiveSelector(Core<typename Mesh::Scalar>& core,
                                                 Collapser<Mesh>& collapser) {
  return std::make_unique<ExhaustiveSelector<Mesh>>(core, collapser);
}

template std::unique_ptr<Selector> makeExhaustiveSelector(Core<float>&, Collapser<Window<float>>&);
template std::unique_ptr<Selector> makeExhaustiveSelector(Core<double>&,
                                                          Collapser<Window<double>>&);
template std::unique_ptr<Selector> makeExhaustiveSelector(Core<float>&, Collapser<Patch<float>>&);
template std::unique_ptr<Selector> makeExhaustiveSelector(Core<double>&, Collapser<Patch<double>>&);

}  // namespace tetstream
