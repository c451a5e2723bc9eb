// simplify: patches swept at rising bounds. See select.h.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "choices.h"
#include "reshape.h"
#include "select.h"
#include "settled.h"
#include "solutions.h"
#include "sweep_bounds.h"
#include "tiling.h"

namespace tetstream {
namespace {

constexpr uint32_t kAlways = 0xffffffffu, kAtSeam = kAlways - 1;  // marks above all others
// Within a patch edges are taken at bounds rising to the pass's, nearly in order of their error.
constexpr float kFirstLevel = 1.0f / 256, kLevelStep = 2;
// An edge whose collapse makes more cells thin than it should is taken at this times its error.
constexpr float kThinPrice = 2;
constexpr int64_t kLeastRoom = 8;    // cells; a collapse takes 5 or 6
constexpr int64_t kSlackShare = 50;  // one part in these of a goal is no reason for another pass

template <class S>
class SweepSelector final : public Selector {
 public:
  SweepSelector(Core<S>& core, Account& account)
      : core_(core),
        tiling_(core, account),
        bounds_(core),
        patch_(account, core.window),
        collapser_(core, patch_, account),
        exhaustive_(makeExhaustiveSelector(core, collapser_)),
        choices_(account),
        solutions_(core, account),
        errors_(account),
        neighbours_(account),
        seen_(account),
        looks_(account),
        spared_(account),
        z_(static_cast<size_t>(core.plan.dimension)) {
    if (core.options.shape == Shape::kSolver) reshaper_.emplace(core, patch_, account);
  }

  void decimate(const Goal& goal, const std::function<void()>& tick) override {
    goal_ = goal;
    int exponent;
    unit_ = std::frexp(core_.error_unit, &exponent);
    core_.error_reached = false;
    if (reshaper_ && core_.tracer && core_.tracer->tracesPoints()) reshaper_->observe(core_.tracer);
    sweep(tick);
    if (goal.last && core_.options.last_resort && !mustStop(core_.window.liveCells()))
      sweepOut(tick);
    // Twice, with seams that lie elsewhere.
    for (int round = 0; reshaper_ && round < 2; ++round) reshapeAll(tick);
  }

  double bound() const override { return bound_ / unit_; }

 private:
  // The last goal is met exactly; for others another pass must be worth its time.
  bool reached() const {
    const int64_t slack = goal_.last ? 0 : (goal_.cells - goal_.fixed) / kSlackShare;
    return core_.window.liveCells() <= goal_.cells + slack;
  }
  // No goal is undercut; where only a ring's cells or so may go, nearly all edges take too many.
  bool mustStop(int64_t live) const {
    const int64_t room = live - goal_.least_cells;
    return (goal_.last ? live <= goal_.cells || room <= 0 : room <= kLeastRoom) ||
           core_.error_reached;
  }
  void sweep(const std::function<void()>& tick);
  void sweepOut(const std::function<void()>& tick);
  double firstBound();
  bool pass(float bound, const std::function<void()>& tick);
  template <class Work>
  void onPatch(const uint32_t* owned, size_t owned_count, const uint32_t* cells, size_t cell_count,
               Work work);
  template <class Work>
  void onTile(const TilePiece& tile, Work work) {
    onPatch(tiling_.vertices(tile), tile.vertexCount(), tiling_.cells(tile), tile.cell_count, work);
  }
  void tryEverything(const std::function<void()>& tick);

  bool reshape();
  void reshapeAll(const std::function<void()>& tick);
  bool sweepPatch(float bound);
  void evaluateAll(float bound);
  void settleAll();
  void findSeams();
  float leastAcrossSeam(uint32_t v);
  void addEdges(uint32_t v);
  float sweepLevel(float level, bool spares);
  void sweepSpared(float level);
  VertexTable<S> vertices() const;
  void solveFrom(uint32_t v, float level);
  S solve(uint32_t v, uint32_t w, float level);
  void collapseFrom(uint32_t v, float level, bool spares);
  void pushAfter(uint32_t u, uint32_t gone);
  void startList(uint32_t v, size_t cells);
  void listNeighbours(uint32_t v);
  void listNeighboursOfMerged(uint32_t u);
  void measureNeighbours(uint32_t u);
  void measureIn(const VertexTable<S>& table, uint32_t u);

  Core<S>& core_;
  Tiling<S> tiling_;
  SweepBounds<S> bounds_;
  Patch<S> patch_;
  Collapser<Patch<S>> collapser_;
  std::optional<Reshaper<S>> reshaper_;  // where shapes come first
  std::unique_ptr<Selector> exhaustive_;
  Choices choices_;
  Solutions<S> solutions_;
  Array<S> errors_;
  Array<uint32_t> neighbours_, seen_;  // seen_: per vertex, the mark_ of its last listing
  Array<uint8_t> looks_;               // of an owned vertex: at all its edges
  Array<float> spared_;                // and the least error of those that were spared
  std::vector<S> z_;
  size_t count_ = 0;  // of the neighbours listed
  uint32_t mark_ = 0;
  Goal goal_{};
  // Errors here are in units of the whole, up to a power of two: rounded, they order alike in
  // whatever units the mesh is.
  double unit_ = 1, bound_ = 0;
  unsigned round_ = 0;
};

template <class S>
void SweepSelector<S>::sweep(const std::function<void()>& tick) {
  if (mustStop(core_.window.liveCells())) return;
  int approaches = goal_.approaches;
  double bound = bounds_.start(goal_.first_bound * unit_, approaches);
  for (bool first = true;; first = false) {
    constexpr float kAll = std::numeric_limits<float>::infinity();
    tiling_.build(round_++, bound > 0 ? static_cast<float>(bound) : kAll);
    if (!(bound > 0)) bound = firstBound();
    const int64_t before = core_.window.liveCells();
    const bool more = pass(static_cast<float>(bound), tick) || tiling_.othersWait();
    // A pass that the limit on the error ended was left half done: the one before tells the bound.
    if (!core_.error_reached || first) bound_ = bound;
    if (!more) return;
    const bool on_the_way = approaches-- > 0 && core_.window.liveCells() > goal_.enough_cells;
    if (!on_the_way && (reached() || core_.error >= goal_.most_error)) return;
    if (!first)  // in that, most vertices are new
      bounds_.learn(before - core_.window.liveCells(), tiling_.looking());
    bound = on_the_way ? 2 * bound : bounds_.next(bound, goal_);
  }
}

// Works on a patch, or on its halves where it is too large for one.
template <class S>
template <class Work>
void SweepSelector<S>::onPatch(const uint32_t* owned, size_t owned_count, const uint32_t* cells,
                               size_t cell_count, Work work) {
  if (owned_count <= Choices::kMostVertices && patch_.load(owned, owned_count, cells, cell_count)) {
    work();
    return;
  }
  if (owned_count == 1) return;  // a star of that size is left alone
  const size_t half = owned_count / 2;
  onPatch(owned, half, cells, cell_count, work);
  onPatch(owned + half, owned_count - half, cells, cell_count, work);
}

// Returns whether a higher bound, or another pass, could do more.
template <class S>
bool SweepSelector<S>::pass(float bound, const std::function<void()>& tick) {
  bool more = false;
  for (const TilePiece& tile : tiling_.tiles()) {
    onTile(tile, [&] {
      more = sweepPatch(bound) || more;
      const bool reshaped = reshaper_ && reshape();
      patch_.store();
      settleAll();
      if (reshaped) reshaper_->unsettleChanged();
    });
    tick();
    if (mustStop(core_.window.liveCells())) return false;
  }
  return more;
}

template <class S>
double SweepSelector<S>::firstBound() {
  std::vector<float> errors;
  for (size_t i = 0; i < tiling_.tiles().size(); i += tiling_.tiles().size() / 4 + 1) {
    onTile(tiling_.tiles()[i], [&] {
      evaluateAll(std::numeric_limits<float>::infinity());
      for (uint32_t v = 0; v < patch_.ownedEnd(); ++v)
        if (std::isfinite(choices_.least(v))) errors.push_back(choices_.least(v));
    });
  }
  return bounds_.first(errors, goal_);
}

// Until a round, whose seams lie elsewhere, finds nothing more.
template <class S>
void SweepSelector<S>::tryEverything(const std::function<void()>& tick) {
  int64_t live;
  do {
    live = core_.window.liveCells();
    tiling_.build(round_++, std::numeric_limits<float>::infinity());
    for (const TilePiece& tile : tiling_.tiles()) {
      onTile(tile, [&] {
        exhaustive_->decimate(goal_, tick);
        patch_.store();
      });
      if (mustStop(core_.window.liveCells())) return;
    }
  } while (core_.window.liveCells() < live);
}

// The target is not reached: edges are tried one by one, then with less regard for shapes.
template <class S>
void SweepSelector<S>::sweepOut(const std::function<void()>& tick) {
  tryEverything(tick);
  while (!mustStop(core_.window.liveCells())) {
    const double floor = core_.thin.degrees;
    if (reshaper_) reshapeAll(tick);
    core_.thin = ThinAngle(reshaper_ ? std::max(floor / 2, kLeastFloor) : kLeastFloor);
    tryEverything(tick);
    if (!reshaper_ || floor == kLeastFloor) return;
  }
}

// A target that is reached stays so.
template <class S>
bool SweepSelector<S>::reshape() {
  const bool is_reached = goal_.last && patch_.liveCells() <= goal_.cells;
  return reshaper_->reshape(goal_.least_cells,
                            is_reached ? goal_.cells : std::numeric_limits<int64_t>::max());
}

template <class S>
void SweepSelector<S>::reshapeAll(const std::function<void()>& tick) {
  tiling_.build(round_++, std::numeric_limits<float>::infinity());
  for (const TilePiece& tile : tiling_.tiles()) {
    onTile(tile, [&] {
      if (!reshape()) return;
      patch_.store();
      reshaper_->unsettleChanged();
    });
    tick();
  }
}

// ------------------------------------------------------------------------------- in a patch

template <class S>
void SweepSelector<S>::startList(uint32_t v, size_t cells) {
  if (neighbours_.size() < 4 * cells + 1) neighbours_.resize(8 * cells + 1);
  seen_[v] = ++mark_;
}
// v's neighbours that may be merged with it, each once.
template <class S>
void SweepSelector<S>::listNeighbours(uint32_t v) {
  const uint32_t cells = patch_.starSize(v);
  startList(v, cells);
  count_ = listVertices(patch_.corners(), patch_.starOf(v), cells, seen_.data(), mark_,
                        neighbours_.data());
}
// The same, of what the collapse has gathered.
template <class S>
void SweepSelector<S>::listNeighboursOfMerged(uint32_t u) {
  const Stars& stars = collapser_.stars();
  startList(u, stars.u.size() + stars.v.size());
  count_ = listVertices(stars.u.begin(), stars.u.size(), seen_.data(), mark_, neighbours_.data());
  count_ += listVertices(stars.v.begin(), stars.v.size(), seen_.data(), mark_,
                         neighbours_.data() + count_);
}

template <class S>
VertexTable<S> SweepSelector<S>::vertices() const {
  return {patch_.allQuadrics(), patch_.allValues(), core_.window.shape().quadric,
          patch_.valueStride()};
}
template <class S>
void SweepSelector<S>::measureNeighbours(uint32_t u) {
  measureIn(vertices(), u);
}
template <class S>
void SweepSelector<S>::measureIn(const VertexTable<S>& table, uint32_t u) {
  if (errors_.size() < count_) errors_.resize(neighbours_.size());
  core_.kernels.edgeErrors(table, u, neighbours_.data(), static_cast<int>(count_),
                           core_.scale.data(), core_.plan.dimension, errors_.data());
  for (size_t i = 0; i < count_; ++i) errors_[i] *= static_cast<S>(unit_);
}

// v's edges to later vertices, and to those that do not look at theirs, for both ends.
template <class S>
void SweepSelector<S>::addEdges(uint32_t v) {
  listNeighbours(v);
  size_t later = 0;
  for (size_t i = 0; i < count_; ++i) {
    neighbours_[later] = neighbours_[i];
    later += neighbours_[i] > v || !looks_[neighbours_[i]];
  }
  count_ = later;
  measureNeighbours(v);
  choices_.add(v, errors_.data(), neighbours_.data(), count_);
}

template <class S>
void SweepSelector<S>::evaluateAll(float bound) {
  choices_.reset(patch_.ownedEnd());
  solutions_.reset(patch_.ownedEnd());
  if (looks_.size() < patch_.ownedEnd()) {
    looks_.resize(patch_.ownedEnd() + 1024);
    spared_.resize(looks_.size());
  }
  std::fill_n(spared_.data(), patch_.ownedEnd(), std::numeric_limits<float>::infinity());
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v) {
    const Settled s = settledOf(core_.window, patch_.slotOf(v));
    looks_[v] = s.least <= bound;
    if (!looks_[v])
      choices_.know(v, s.least, s.refused);
    else if (s.least > 0 && !s.spared)
      choices_.passOver(v, s.least, s.refused);
  }
  // The rim and what dead cells hold count as seen, always.
  if (seen_.size() == 0) seen_.resize(size_t{kGoneCorner} + 1);
  std::fill_n(seen_.data(), patch_.ownedEnd(), 0u);
  std::fill(seen_.data() + patch_.ownedEnd(), seen_.data() + patch_.vertexEnd(), kAlways);
  seen_[kGoneCorner] = kAlways;
  mark_ = 0;
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v)
    if (looks_[v]) addEdges(v);
}

// The merged vertex measures its edges and tells its neighbours.
template <class S>
void SweepSelector<S>::pushAfter(uint32_t u, uint32_t gone) {
  listNeighboursOfMerged(u);
  measureNeighbours(u);
  solutions_.moved(u);
  choices_.forget(gone);
  choices_.forget(u);
  choices_.relist(u, errors_.data(), neighbours_.data(), count_);
  for (size_t i = 0; i < count_; ++i)
    choices_.replace(neighbours_[i], u, gone, static_cast<float>(errors_[i]));
}

// The best edges of v and of the next vertices that have one up to the level.
template <class S>
void SweepSelector<S>::solveFrom(uint32_t v, float level) {
  solutions_.clear();
  uint32_t found[kEdgeLanes + Choices::kBlock];
  const uint32_t count = choices_.listUpTo(level, v, kEdgeLanes, found);
  for (uint32_t i = 0; i < count && !solutions_.full(); ++i)
    if (!choices_.mustLookAgain(found[i])) solutions_.add(found[i], choices_.target(found[i]));
  solutions_.solve(vertices());
}

// The error of the edge; z_ becomes its minimizer.
template <class S>
S SweepSelector<S>::solve(uint32_t v, uint32_t w, float level) {
  if (!solutions_.reach(v)) solveFrom(v, level);
  S error;
  if (const S* z = solutions_.find(v, w, &error)) {
    std::copy_n(z, z_.size(), z_.data());
    return error;
  }
  return core_.kernels.solveEdge(patch_.quadric(v), patch_.values(v), patch_.quadric(w),
                                 patch_.values(w), core_.scale.data(), core_.plan.dimension,
                                 z_.data());
}

// Tries v's edges of errors up to the level, best first, until one is collapsed.
template <class S>
void SweepSelector<S>::collapseFrom(uint32_t v, float level, bool spares) {
  while (choices_.least(v) <= level) {
    if (choices_.mustLookAgain(v)) {
      listNeighbours(v);
      measureNeighbours(v);
      choices_.relist(v, errors_.data(), neighbours_.data(), count_);
      continue;
    }
    const uint32_t w = choices_.target(v);
    const S error = solve(v, w, level);
    const Outcome outcome = collapser_.collapse(v, w, z_.data(), error, goal_.least_cells, spares);
    if (outcome == Outcome::kDone) {
      pushAfter(v, w);
      return;
    }
    if (outcome == Outcome::kDear) spared_[v] = std::min(spared_[v], choices_.least(v));
    choices_.refuse(v, w);
  }
}

// Returns the least error of an edge that is left, infinity if none is.
template <class S>
float SweepSelector<S>::sweepLevel(float level, bool spares) {
  float least = std::numeric_limits<float>::infinity();
  solutions_.clear();
  for (uint32_t block = 0; block < patch_.ownedEnd(); block += Choices::kBlock) {
    if (choices_.leastOfBlock(block) <= level)
      for (uint32_t v = block; v < block + Choices::kBlock; ++v) {
        if (!(choices_.least(v) <= level)) continue;
        collapseFrom(v, level, spares);
        if (mustStop(patch_.liveCells())) return std::numeric_limits<float>::infinity();
      }
    least = std::min(least, choices_.leastOfBlock(block));
  }
  return least;
}

// What was spared at lower levels has its price now.
template <class S>
void SweepSelector<S>::sweepSpared(float level) {
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v) {
    if (!(spared_[v] <= level)) continue;
    spared_[v] = std::numeric_limits<float>::infinity();
    choices_.reconsider(v);
  }
  while (sweepLevel(level, false) <= level) {
  }
}

template <class S>
bool SweepSelector<S>::sweepPatch(float bound) {
  evaluateAll(bound);
  float level = bound * kFirstLevel, least;
  for (;;) {
    choices_.reconsider();
    if (core_.spares()) sweepSpared(level / kThinPrice);
    do least = sweepLevel(level, true);
    while (least <= level);
    if (level >= bound || mustStop(patch_.liveCells())) break;
    level = std::min(std::max(level * kLevelStep, least), bound);
  }
  return least < std::numeric_limits<float>::infinity();
}

// The least error of v's edges to vertices of other patches. Those that had refused edges must
// look at them again if v changed.
template <class S>
float SweepSelector<S>::leastAcrossSeam(uint32_t v) {
  listNeighbours(v);
  Window<S>& window = core_.window;
  for (size_t i = 0; i < count_; ++i) {
    neighbours_[i] = patch_.slotOf(neighbours_[i]);
    if (solutions_.hasMoved(v) && settledOf(window, neighbours_[i]).refused)
      unsettle(window, neighbours_[i]);
  }
  measureIn(
      {window.allQuadrics(), window.allValues(), window.shape().quadric, window.shape().values},
      patch_.slotOf(v));
  S least = std::numeric_limits<S>::infinity();
  for (size_t i = 0; i < count_; ++i) least = errors_[i] < least ? errors_[i] : least;  // no NaN
  return static_cast<float>(least);
}

// Seen, from now on, are all but the free vertices of other patches; those of this one that share a
// cell with such a vertex are marked.
template <class S>
void SweepSelector<S>::findSeams() {
  std::fill_n(seen_.data(), patch_.ownedEnd(), kAlways);
  for (uint32_t x = patch_.ownedEnd(); x < patch_.vertexEnd(); ++x)
    if (patch_.isFreeElsewhere(x)) seen_[x] = 0;
  for (uint32_t c = 0; c < patch_.cellEnd(); ++c) {
    bool at_seam = false;
    for (uint32_t j = 0; j < 4; ++j) at_seam |= seen_[patch_.vertexOf(c, j)] == 0;
    if (!at_seam) continue;
    for (uint32_t j = 0; j < 4; ++j)
      if (patch_.vertexOf(c, j) < patch_.ownedEnd()) seen_[patch_.vertexOf(c, j)] = kAtSeam;
  }
}

// What is known now is kept for the next sweep, in the window.
template <class S>
void SweepSelector<S>::settleAll() {
  choices_.reconsider();
  findSeams();
  for (uint32_t v = 0; v < patch_.ownedEnd(); ++v) {
    if (!patch_.isFree(v)) continue;
    float least = choices_.least(v);
    if (seen_[v] == kAtSeam && (looks_[v] || solutions_.hasMoved(v)))
      least = std::min(least, leastAcrossSeam(v));
    const bool spared = spared_[v] < std::numeric_limits<float>::infinity();
    settle(core_.window, patch_.slotOf(v),
           {std::min(least, kThinPrice * spared_[v]), choices_.hasRefused(v), spared});
  }
}

}  // namespace

template <class S>
std::unique_ptr<Selector> makeSweepSelector(Core<S>& core, Account& account) {
  return std::make_unique<SweepSelector<S>>(core, account);
}

template std::unique_ptr<Selector> makeSweepSelector(Core<float>&, Account&);
template std::unique_ptr<Selector> makeSweepSelector(Core<double>&, Account&);

}  // namespace tetstream
