// simplify/select: the cheapest of all edges first. See select.h.
#include <algorithm>
#include <limits>

#include "queued_edges.h"
#include "select.h"

namespace tetstream {
namespace {

constexpr int kStepsPerTick = 4096;
// Edges that were not legal are tried again when one cell in so many has gone since, and when no
// others are left. On real meshes reduced to a tenth: with 3 the error is 0.5 to 6 % larger; with
// 32 as it is, for twice the refusals and a fifth of the time more.
constexpr int64_t kRetryShare = 8;

template <class S>
class QueueSelector final : public Selector {
 public:
  QueueSelector(Core<S>& core, Collapser<Window<S>>& collapser, Account& account)
      : core_(core),
        collapser_(collapser),
        edges_(account),
        star_(account),
        no_ring_(account),
        exhaustive_(makeExhaustiveSelector(core, collapser)),
        z_(static_cast<size_t>(core.plan.dimension)) {}

  void decimate(const Goal& goal, const std::function<void()>& tick) override {
    goal_ = goal;
    if (reached()) return;
    build(tick);
    collapseInOrder(tick);
    if (goal.last && core_.options.last_resort && !reached()) exhaustive_->decimate(goal, tick);
  }

 private:
  bool reached() const { return core_.window.mesh.liveCells() <= goal_.cells; }
  void build(const std::function<void()>& tick);
  void collapseInOrder(const std::function<void()>& tick);
  bool collapse(const QueuedEdge& edge);
  void renew(uint32_t u);
  void queueEdges(uint32_t u, const Star& star, uint32_t above);
  S minimize(uint32_t u, uint32_t v);

  // Kept where a vertex that is written has its rank.
  uint64_t& stampOf(uint32_t v) { return core_.window.outRank(v); }
  uint32_t stampOf(uint32_t u, uint32_t v) {
    return static_cast<uint32_t>(stampOf(u) + stampOf(v));
  }
  bool isCurrent(const QueuedEdge& edge) {
    const Topology& mesh = core_.window.mesh;
    return mesh.isFree(edge.u) && mesh.isFree(edge.v) && edge.stamp == stampOf(edge.u, edge.v);
  }

  Core<S>& core_;
  Collapser<Window<S>>& collapser_;
  QueuedEdges edges_;
  Star star_, no_ring_;
  std::unique_ptr<Selector> exhaustive_;
  std::vector<S> z_;
  Goal goal_{};
  uint32_t mark_ = 0;  // of the last vertex whose neighbours were queued
};

// The error, and z_ of the minimizer.
template <class S>
S QueueSelector<S>::minimize(uint32_t u, uint32_t v) {
  Window<S>& window = core_.window;
  return core_.kernels.minimizeEdge(window.quadric(u), window.values(u), window.quadric(v),
                                    window.values(v), core_.scale.data(), core_.plan.dimension,
                                    z_.data());
}

// The edges from u to the free vertices of its star, those from slot `above` on. Of one that the
// star has often only the first time counts.
template <class S>
void QueueSelector<S>::queueEdges(uint32_t u, const Star& star, uint32_t above) {
  uint32_t* const seen = core_.window.scratch();
  for (const StarCell& cell : star)
    for (uint32_t w : cell.t) {
      if (w < above || seen[w] == mark_ || !core_.window.mesh.isFree(w)) continue;
      seen[w] = mark_;
      const S error = minimize(u, w);
      if (!(error <= std::numeric_limits<S>::max())) continue;
      const S most = std::numeric_limits<float>::max();
      edges_.push({static_cast<float>(std::min(error, most)), u, w, stampOf(u, w)},
                  [this](const QueuedEdge& edge) { return isCurrent(edge); });
    }
}

// All edges between free vertices, each from its lower slot.
template <class S>
void QueueSelector<S>::build(const std::function<void()>& tick) {
  Window<S>& window = core_.window;
  edges_.clear();
  mark_ = 0;
  std::fill_n(window.scratch(), window.mesh.vertexEnd(), mark_);
  for (uint32_t u = 0; u < window.mesh.vertexEnd(); ++u)
    if (window.mesh.isFree(u)) stampOf(u) = 0;
  for (uint32_t u = 0; u < window.mesh.vertexEnd(); ++u) {
    if (u % kStepsPerTick == 0) tick();
    if (!window.mesh.isFree(u)) continue;
    window.gather(u, kNone, star_, no_ring_);
    ++mark_;
    queueEdges(u, star_, u + 1);
  }
}

// After another vertex was merged into u: what was queued of it is out of date.
template <class S>
void QueueSelector<S>::renew(uint32_t u) {
  ++stampOf(u);
  ++mark_;
  queueEdges(u, collapser_.stars().u, 0);
  queueEdges(u, collapser_.stars().v, 0);
}

template <class S>
bool QueueSelector<S>::collapse(const QueuedEdge& edge) {
  const S error = minimize(edge.u, edge.v);
  if (collapser_.collapse(edge.u, edge.v, z_.data(), error, goal_.least_cells) != Outcome::kDone)
    return false;
  renew(edge.u);
  return true;
}

template <class S>
void QueueSelector<S>::collapseInOrder(const std::function<void()>& tick) {
  const Topology& mesh = core_.window.mesh;
  int64_t cells_then = mesh.liveCells();  // when all edges were queued
  for (int64_t step = 1; !reached(); ++step) {
    if (step % kStepsPerTick == 0) tick();
    const int64_t gone = cells_then - mesh.liveCells();
    const bool is_due = edges_.empty() ? gone > 0 : gone > cells_then / kRetryShare;
    if (is_due && core_.options.tries_again) {
      edges_.wakeAll();
      cells_then = mesh.liveCells();
    }
    if (edges_.empty()) return;  // nothing legal is left
    const QueuedEdge edge = edges_.pop();
    if (isCurrent(edge) && !collapse(edge)) edges_.wait(edge);
  }
}

}  // namespace

template <class S>
std::unique_ptr<Selector> makeQueueSelector(Core<S>& core, Collapser<Window<S>>& collapser,
                                            Account& account) {
  return std::make_unique<QueueSelector<S>>(core, collapser, account);
}

template std::unique_ptr<Selector> makeQueueSelector(Core<float>&, Collapser<Window<float>>&,
                                                     Account&);
template std::unique_ptr<Selector> makeQueueSelector(Core<double>&, Collapser<Window<double>>&,
                                                     Account&);

}  // namespace tetstream
