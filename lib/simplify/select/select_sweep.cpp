// simplify/select: patches swept at rising bounds. See select.h.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>
#include <utility>

#include "dear_angles.h"
#include "error_sample.h"
#include "lane.h"
#include "select.h"
#include "settled.h"
#include "sweep_bounds.h"
#include "tasks.h"
#include "tile_group.h"
#include "tile_queue.h"
#include "tiling.h"

namespace tetstream {
namespace {

constexpr int64_t kSlackShare = 50;  // one part in these of a goal is no reason for another pass
// A pass that missed its goal with this many edges refused for thin cells to one that is collapsed,
// and with one to so many cells of the window, needs another floor, not a higher bound: of
// stretched meshes whose cells all lie just above the floor what was left at last was collapsed at
// any error.
constexpr int64_t kThinToDone = 10, kCellsToThin = 16;
constexpr float kNoBound = std::numeric_limits<float>::infinity();

// Tiles are swept in their order, or at the same time where that makes no difference: those that
// share no cell, and whose number is such that what they take cannot meet the goal between them.
// Each then finds what it would have found in its turn, and what they did is added in their order,
// so that the result is that of one thread for any number of threads.
template <class S>
class SweepSelector final : public Selector {
 public:
  SweepSelector(Core<S>& core, Account& account)
      : core_(core), account_(account), tiling_(core, account), bounds_(core) {
    addLane();
  }

  void decimate(const Goal& goal, const std::function<void()>& tick) override {
    goal_ = goal;
    int exponent;
    unit_ = std::frexp(core_.error_unit, &exponent);
    for (auto& lane : lanes_) lane->begin(goal_, unit_);
    was_stopped_ |= std::exchange(core_.tally.error_reached, false);
    sweep(bounds_.start(goal_, unit_), goal_.approaches, tick);
    const bool sweeps_out = goal.last && core_.options.last_resort && !mustStop();
    if (sweeps_out) sweepOut(tick);
    // Twice, with seams that lie elsewhere.
    for (int round = 0; core_.shapesFirst() && round < 2; ++round)
      reshapeAll(sweeps_out && round == 0, tick);
    if (goal.last && was_stopped_ && !reached()) core_.tally.error_reached = true;
  }

  double bound() const override { return bound_ / unit_; }

 private:
  struct Swept {  // of a tile
    Tally tally;
    int64_t died = 0;
    bool more = false;  // a higher bound, or another pass, could do more
  };

  // The last goal is met exactly; for others another pass must be worth its time.
  bool reached() const {
    const int64_t slack = goal_.last ? 0 : (goal_.cells - goal_.fixed) / kSlackShare;
    return core_.window.liveCells() <= goal_.cells + slack;
  }
  bool mustStop() const {
    return goal_.isMet(core_.window.liveCells()) || core_.tally.error_reached;
  }
  void addLane() {
    lanes_.push_back(std::make_unique<Lane<S>>(core_, account_));
    lanes_.back()->begin(goal_, unit_);
  }
  Lane<S>& lane() { return *lanes_[0]; }
  void sweep(double bound, int approaches, const std::function<void()>& tick);
  bool leavesErrorAfterAll(int64_t cells_before);
  bool isStoppedByFloor(const Tally& before, int64_t cells_before) const;
  void lowerFloor();
  void sweepOut(const std::function<void()>& tick);
  double firstBound();
  void listErrors(Lane<S>& lane, std::vector<float>& errors);
  template <class Work>
  void shareOut(size_t pieces, Work work);
  void cut(float bound, TileLayout layout);
  bool pass(float bound, const std::function<void()>& tick);
  bool worksInOrder() const;
  TileLayout layout() const;
  bool takesShares() const;
  TileGroup nextGroup(size_t first) const;
  Goal goalOf(const TilePiece& tile) const;
  void sweepGroup(size_t first, size_t end, float bound, const std::function<void()>& tick);
  Swept sweepTile(size_t tile, float bound, Lane<S>& lane, TileQueue& queue);
  bool add(const Swept& swept);
  void addOf(Lane<S>& lane) { add({lane.sweep().takeTally(), lane.sweep().takeDied()}); }
  template <class Work>
  void onTile(Lane<S>& lane, const TilePiece& tile, Work work, bool is_loaded = false) {
    const uint32_t* const cells =
        lane.listed([&](Array<uint32_t>& room) { return tiling_.listCells(tile, room); });
    lane.onPatch(tiling_.vertices(tile), tile.vertexCount(), cells, tile.cell_count, is_loaded,
                 work);
  }
  void tryByAllMeans(const std::function<void()>& tick);
  void tryEverything(const std::function<void()>& tick);
  bool reshape(Lane<S>& lane, const Goal& goal, float bound);
  template <class HasMoved>
  bool reshapeFirst(Lane<S>& lane, const Goal& goal, HasMoved hasMoved);
  void reshapeAll(bool any_moved, const std::function<void()>& tick);

  Core<S>& core_;
  Account& account_;
  Tiling<S> tiling_;
  SweepBounds<S> bounds_;
  std::vector<std::unique_ptr<Lane<S>>> lanes_;
  std::vector<Swept> swept_;
  typename SweepBounds<S>::Refused refused_{};  // by the last round of trying everything
  bool was_stopped_ = false;                    // in a window before, by the limit on the error
  double share_ = 1;                            // of its cells that a tile of the group may take
  Goal goal_{};
  double unit_ = 1, bound_ = 0;
  bool is_ready_ = false;  // the only tile is loaded in the first lane, and its edges are evaluated
  unsigned round_ = 0;
};

template <class S>
void SweepSelector<S>::cut(float bound, TileLayout layout) {
  if (lane().takeRefusals() > 0) tiling_.useSmallerTiles();
  lane().withoutPatch([&] { tiling_.build(round_, bound, layout); });
  ++round_;
}

// With so many passes on the way to the bound that the goal gives.
template <class S>
void SweepSelector<S>::sweep(double bound, int approaches, const std::function<void()>& tick) {
  if (mustStop()) return;
  bool are_stuck = false;
  for (bool first = true;; first = false) {
    cut(bound > 0 ? static_cast<float>(bound) : kNoBound, layout());
    if (!(bound > 0)) bound = firstBound();
    if (makeDearWhereFewAreLeft(core_, are_stuck))
      for (auto& lane : lanes_) lane->begin(goal_, unit_);
    const int64_t before = core_.window.liveCells();
    const Tally so_far = core_.tally;
    bool more = pass(static_cast<float>(bound), tick) || tiling_.othersWait();
    // What is left out, of a pass that could do nothing, is left to what comes after all passes.
    more |= tiling_.leavesOut() && core_.window.liveCells() < before;
    if (leavesErrorAfterAll(before)) continue;
    // A pass that the limit on the error ended was left half done: the one before tells the bound.
    if (!core_.tally.error_reached || first) bound_ = bound;
    if (core_.tally.error_reached) return;
    const bool by_floor = isStoppedByFloor(so_far, before);
    if (!more && (mustStop() || !by_floor)) return;
    const bool on_the_way = approaches-- > 0 && core_.window.liveCells() > goal_.enough_cells;
    if (!on_the_way && (reached() || core_.tally.error >= goal_.most_error)) return;
    if (by_floor) {
      lowerFloor();
      continue;
    }
    const int64_t taken = before - core_.window.liveCells();
    if (!first) bounds_.learn(taken, tiling_.looking());  // in that, most vertices are new
    are_stuck = bounds_.areStuck(taken, goal_);
    const double last = bound;
    const double wanted =
        on_the_way ? bounds_.onTheWay(bound, goal_) : bounds_.wanted(bound, goal_);
    bound = bounds_.next(bound, wanted);
    if (bound == last) return;
  }
}

// Up to a bound on the error what was made is measured after a pass. Returns whether one that was
// ended by what the quadrics tell, and made something, may go on.
template <class S>
bool SweepSelector<S>::leavesErrorAfterAll(int64_t cells_before) {
  if (!(core_.options.error > 0)) return false;
  const bool is_left = core_.error_sample->limitErrorAfterPass();
  const bool goes_on =
      is_left && core_.tally.error_reached && core_.window.liveCells() < cells_before;
  if (goes_on) core_.tally.error_reached = false;
  return goes_on;
}

template <class S>
bool SweepSelector<S>::isStoppedByFloor(const Tally& before, int64_t cells_before) const {
  if (core_.shapesFirst() || core_.thin.degrees <= kLeastFloor || core_.tally.error_reached ||
      core_.window.liveCells() <= goal_.cells)
    return false;
  const int64_t thin = core_.tally.rejected_thin - before.rejected_thin;
  return thin > kThinToDone * (core_.tally.collapses - before.collapses) &&
         kCellsToThin * thin > cells_before;
}

// For the rest of this window; what was refused is tried again.
template <class S>
void SweepSelector<S>::lowerFloor() {
  core_.thin = ThinAngle(std::max(core_.thin.degrees / 2, kLeastFloor));
  for (uint32_t v = 0; v < core_.window.mesh.vertexEnd(); ++v)
    if (core_.window.isFree(v) && settledOf(core_.window, v).refused) unsettle(core_.window, v);
}

template <class S>
bool SweepSelector<S>::add(const Swept& swept) {
  core_.tally.add(swept.tally);
  core_.window.mesh.countOut(swept.died);
  return swept.more;
}

// Returns whether a higher bound, or another pass, could do more.
template <class S>
bool SweepSelector<S>::pass(float bound, const std::function<void()>& tick) {
  bool more = false;
  for (size_t first = 0; first < tiling_.tiles().size();) {
    const TileGroup group = nextGroup(first);
    share_ = group.share;
    sweepGroup(first, group.end, bound, tick);
    first = group.end;
    for (const Swept& swept : swept_) more = add(swept) || more;
    tick();  // whichever threads have swept them
    if (mustStop()) return false;
  }
  return more;
}

// Whether what a tile does may depend on the one before, whatever lies between them: on the error
// made so far, where it has a limit; the hash of labelled faces, common to all.
template <class S>
bool SweepSelector<S>::worksInOrder() const {
  return std::isfinite(core_.error_limit) || core_.window.faces.anyPlaced();
}

// Whether all tiles of a pass of the last goal may be swept at the same time, each taking a share
// of its cells.
template <class S>
bool SweepSelector<S>::takesShares() const {
  const int64_t live = core_.window.liveCells();
  return core_.shapesFirst() && goal_.last && core_.options.memory_bytes == 0 && !worksInOrder() &&
         static_cast<double>(goal_.left(live)) > kLeastShareOfSlices * static_cast<double>(live);
}

template <class S>
TileLayout SweepSelector<S>::layout() const {
  if (takesShares()) return TileLayout::kSlices;
  const bool several = core_.options.memory_bytes == 0 && !worksInOrder();
  if (!several) return TileLayout::kWhole;
  return goal_.last ? TileLayout::kApart : TileLayout::kPieces;
}

template <class S>
TileGroup SweepSelector<S>::nextGroup(size_t first) const {
  if (worksInOrder()) return {first + 1};
  const double of_shapes = tiling_.areSlices() ? kLeastShareOfSlices : kLeastShare;
  return groupFrom(tiling_.tiles(), first, core_.window.liveCells(), goal_,
                   core_.shapesFirst() ? of_shapes : kAlike);
}

// Of a tile of a group: it stops when its share is taken.
template <class S>
Goal SweepSelector<S>::goalOf(const TilePiece& tile) const {
  if (!(share_ < 1)) return goal_;
  Goal goal = goal_;
  goal.last = false;
  goal.least_cells = core_.window.liveCells() -
                     static_cast<int64_t>(share_ * static_cast<double>(tile.cell_count));
  return goal;
}

// work(lane) by as many threads as have a piece to do, each in a lane of its own.
template <class S>
template <class Work>
void SweepSelector<S>::shareOut(size_t pieces, Work work) {
  const Tasks* const tasks = core_.tasks();
  const size_t lanes = tasks ? std::min(pieces, core_.mostThreads()) : 1;
  while (lanes_.size() < lanes) addLane();
  if (lanes == 1)
    work(lane());
  else
    tasks->forParts(lanes, [&](size_t l) { work(*lanes_[l]); });
}

template <class S>
void SweepSelector<S>::sweepGroup(size_t first, size_t end, float bound,
                                  const std::function<void()>& tick) {
  swept_.assign(end - first, {});
  TileQueue queue(tiling_.earlier(), tiling_.ahead(), first, end);
  const std::thread::id caller = std::this_thread::get_id();
  const bool several = end - first > 1;
  const auto work = [&](size_t tile, Lane<S>& lane) {
    swept_[tile - first] = sweepTile(tile, bound, lane, queue);
    queue.finish(tile);
    // The user's callbacks know one thread.
    if (several && std::this_thread::get_id() == caller) tick();
  };
  if (core_.tracer) {  // a map and a log are told of them in their order
    for (size_t tile = first; tile < end; ++tile) work(tile, lane());
    return;
  }
  shareOut(end - first, [&](Lane<S>& lane) {
    try {
      while (const std::optional<size_t> tile = queue.take()) work(*tile, lane);
    } catch (...) {
      queue.giveUp();
      throw;
    }
  });
}

// Others may load what is stored of it while this one settles it.
template <class S>
auto SweepSelector<S>::sweepTile(size_t number, float bound, Lane<S>& lane, TileQueue& queue)
    -> Swept {
  const TilePiece& tile = tiling_.tiles()[number];
  const Goal goal = goalOf(tile);
  lane.sweep().begin(goal, unit_);
  Swept swept;
  const auto work = [&] {
    if (!queue.waitForEarlier(number)) return;
    const bool more = lane.sweep().sweep(bound);
    swept.more |= more || (share_ < 1 && goal.isMet(lane.sweep().patch().liveCells()));
    const bool reshaped = core_.flips() && reshape(lane, goal, bound);
    lane.sweep().store();
    const bool is_whole = lane.sweep().patch().ownedEnd() == tile.vertexCount();
    if (is_whole) queue.store(number);
    lane.sweep().settleAll();
    if (reshaped) lane.reshaper().unsettleChanged();
  };
  const bool is_loaded = is_ready_;  // of several tiles, which threads share, none is
  if (is_loaded) is_ready_ = false;
  onTile(lane, tile, work, is_loaded);
  swept.tally = lane.sweep().takeTally();
  swept.died = lane.sweep().takeDied();
  return swept;
}

// Of a few tiles, which threads share.
template <class S>
double SweepSelector<S>::firstBound() {
  const std::vector<TilePiece>& tiles = tiling_.tiles();
  const size_t step = tiles.size() / 4 + 1, count = (tiles.size() + step - 1) / step;
  std::vector<std::vector<float>> found(std::max<size_t>(count, 1));
  std::atomic<size_t> next = 0;
  shareOut(count, [&](Lane<S>& lane) {
    for (size_t i; (i = next++) < count;)
      onTile(lane, tiles[i * step], [&] { listErrors(lane, found[i]); });
  });
  const bool is_whole =
      tiles.size() == 1 && lane().sweep().patch().ownedEnd() == tiles[0].vertexCount();
  is_ready_ = is_whole && lane().sweep().isEvaluated();
  for (size_t i = 1; i < count; ++i)
    found[0].insert(found[0].end(), found[i].begin(), found[i].end());
  return bounds_.first(found[0], goal_);
}

template <class S>
void SweepSelector<S>::listErrors(Lane<S>& lane, std::vector<float>& errors) {
  lane.sweep().evaluateAll(kNoBound);
  for (uint32_t v = 0; v < lane.sweep().patch().ownedEnd(); ++v)
    if (std::isfinite(lane.sweep().least(v))) errors.push_back(lane.sweep().least(v));
}

// Until a round, whose seams lie elsewhere, finds nothing more. Edge by edge towards the last cells
// of a goal: no two tiles at the same time.
template <class S>
void SweepSelector<S>::tryEverything(const std::function<void()>& tick) {
  int64_t live;
  do {
    live = core_.window.liveCells();
    const Tally so_far = core_.tally;
    cut(kNoBound, TileLayout::kWhole);
    for (const TilePiece& tile : tiling_.tiles()) {
      onTile(lane(), tile, [&] {
        makeExhaustiveSelector(core_, lane().sweep().collapser())->decimate(goal_, tick);
        lane().sweep().store();
      });
      addOf(lane());
      if (mustStop()) return;
    }
    refused_ = {core_.tally.rejected_large - so_far.rejected_large,
                core_.tally.rejected() - so_far.rejected()};
  } while (core_.window.liveCells() < live);
}

// The target is not reached up to the limit on the errors: first all that is below it, then more,
// and then more of the regions, if any collapse was refused for what they had lost.
template <class S>
void SweepSelector<S>::sweepOut(const std::function<void()>& tick) {
  do {
    core_.most_error = bounds_.limit();
    core_.most_percent = bounds_.mostPercent();
    int64_t before;
    do {
      before = core_.window.liveCells();
      tryByAllMeans(tick);
    } while (leavesErrorAfterAll(before));
    core_.most_error = std::numeric_limits<double>::infinity();
    if (mustStop()) break;
    const bool is_looser = core_.tally.drift_reached && core_.most_drift < kLastDrift;
    if (!bounds_.widen(goal_, refused_) && !is_looser) break;
    if (is_looser) core_.most_drift = kLastDrift;
    core_.tally.rejected_large = 0;  // for the limit that was
    sweep(bounds_.next(bound_, bounds_.wanted(bound_, goal_)), 0, tick);
  } while (!mustStop());
  core_.most_drift = kMostDrift;
}

// Edges one by one, then with less regard for shapes.
template <class S>
void SweepSelector<S>::tryByAllMeans(const std::function<void()>& tick) {
  tryEverything(tick);
  while (!mustStop()) {
    const double floor = core_.thin.degrees, least = std::min(floor, kLeastFloor);
    if (core_.shapesFirst()) reshapeAll(true, tick);
    core_.thin = ThinAngle(core_.shapesFirst() ? std::max(floor / 2, least) : least);
    tryEverything(tick);
    if (!core_.shapesFirst() || floor == least) return;
  }
}

// After a sweep up to the bound.
template <class S>
bool SweepSelector<S>::reshape(Lane<S>& lane, const Goal& goal, float bound) {
  const auto hasMoved = [&](uint32_t v) { return lane.sweep().hasMoved(v); };
  if (!core_.shapesFirst())
    return lane.reshaper().thinOut(goal.least_cells, static_cast<double>(bound) / unit_, hasMoved);
  return reshapeFirst(lane, goal, hasMoved);
}

// A target that is reached stays so. The other tiles of the group are taken to make errors as this
// one does.
template <class S>
template <class HasMoved>
bool SweepSelector<S>::reshapeFirst(Lane<S>& lane, const Goal& goal, HasMoved hasMoved) {
  const bool is_reached = goal.last && lane.sweep().patch().liveCells() <= goal.cells;
  const double error =
      core_.tally.error + lane.sweep().tally().error * static_cast<double>(swept_.size());
  return lane.reshaper().reshape(goal.least_cells,
                                 is_reached ? goal.cells : std::numeric_limits<int64_t>::max(),
                                 error, hasMoved);
}

// `any_moved`: vertices since the last time, other than in sweeps.
template <class S>
void SweepSelector<S>::reshapeAll(bool any_moved, const std::function<void()>& tick) {
  cut(kNoBound, TileLayout::kWhole);
  for (const TilePiece& tile : tiling_.tiles()) {
    onTile(lane(), tile, [&] {
      if (!reshapeFirst(lane(), goal_, [&](uint32_t) { return any_moved; })) return;
      lane().sweep().store();
      lane().reshaper().unsettleChanged();
    });
    addOf(lane());
    tick();
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
