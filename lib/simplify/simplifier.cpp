#include "simplifier.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "budget.h"
#include "error_sample.h"
#include "intake.h"
#include "missed_target.h"
#include "parking.h"
#include "regions.h"
#include "release.h"
#include "resolve.h"
#include "select.h"
#include "status.h"
#include "window_size.h"

namespace tetstream {
namespace {

constexpr int64_t kTurnsPerWindow = 8;  // at most, where its vertices are few
constexpr int64_t kLongStream = 10;     // windows

// READ, DECIMATE, WRITE (Vo et al. 2007, section 4). Invariants between the steps:
//   - a vertex may move only when it is final and none of its cells has been written, so that its
//     whole star is in the window: whatever a collapse changes lies between two such vertices;
//   - cells leave in the order of their arrival, unless another is asked for, and only when all
//     their vertices are final;
//   - decisions depend on the cells read, never on how batches cut them;
//   - memory is that of the window and of the front's map, allocated before the loop; the window
//     grows between chunks only, when the front proves wider than expected, and for what is parked
//     beside it (parking.h), which counts as written until all has been read.
template <class S>
class WindowedEngine final : public Simplifier::Engine {
 public:
  WindowedEngine(Plan plan, const SimplifyOptions& options, const Pilot& pilot, Sink& out,
                 TraceSinks sinks, const ProgressFunction& progress)
      : plan_(std::move(plan)),
        options_(options),
        progress_(progress),
        account_(static_cast<size_t>(std::max(options.memory_bytes, options.limit_bytes))),
        size_(windowSize<S>(plan_, options_)),
        capacity_(size_.first()),
        core_(plan_, options_, account_, static_cast<size_t>(capacity_), verticesOf(capacity_),
              expectedSpan(plan_.schema)),
        knows_pilot_(pilot.known()),
        knows_parts_(pilot.known() && !pilot.isEven()),
        parked_times_(parkedTimes(plan_.schema, options_, capacity_, pilot)),
        budget_(makeBudget(plan_.schema, options, pilot, parked_times_)),
        intake_(core_, account_),
        regions_(core_),
        metric_(core_),
        resolver_(core_, metric_, account_),
        collapser_(core_, core_.window, account_),
        selector_(makeSelector()),
        release_(core_, out, account_) {
    if (sinks.any()) core_.tracer = &tracer_.emplace(core_.window, plan_, sinks, account_);
    if (plan_.tellsErrors())
      core_.error_sample = &error_sample_.emplace(core_, account_, static_cast<size_t>(capacity_));
    core_.report.window_cells = capacity_;
    core_.target_ratio = targetRatio();
    core_.is_tight = size_.isTight();
    prepareBalance(pilot);
    turn_at_ = firstTurn();
  }

  void put(const BatchView& batch) override {
    explainingBudget([&] { take(batch); });
  }
  void finish() override {
    explainingBudget([&] { end(); });
  }

  Report report() const override {
    Report report = core_.report;
    countInto(report);
    return report;
  }
  Pilot pilot() const override {
    Pilot pilot = pilot_;
    pilot.balance = core_.balance;
    return pilot;
  }

 private:
  Topology& mesh() { return core_.window.mesh; }
  bool parks() const { return parked_times_ > 1; }

  double targetRatio() const {
    const Target target = targetOf(plan_.schema, options_);
    if (target.cells > 0)
      return static_cast<double>(target.cellsOf(plan_.schema.cell_count)) /
             static_cast<double>(plan_.schema.cell_count);
    return target.ratio > 0 ? target.ratio : kUsualRatio;
  }

  // What a pilot found stands for the whole stream; without one the first window does.
  void prepareBalance(const Pilot& pilot) {
    const bool has_fields = plan_.dimension > 3 && plan_.layout == QuadricLayout::kFields;
    const bool is_asked_for = options_.boundary_weight != SimplifyOptions{}.boundary_weight;
    if (options_.balance == BalanceUse::kNever || followsPaper(options_.mode) || !has_fields)
      return;
    core_.balance = pilot.balance;
    core_.weighs_fields = !(options_.error > 0);  // which is in units of their ranges
    if (is_asked_for) return;
    const double least = options_.error > 0 ? kUsualRatio : 0;  // that may end the run long before
    const double wanted = std::max(core_.target_ratio, least);
    core_.balance_ratio = options_.balance_ratio > 0 ? options_.balance_ratio : wanted;
  }

  void take(const BatchView& batch) {
    intake_.startBatch(batch);
    for (size_t row = 0; row < batch.cell_count; ++row) {
      if (mesh().cellEnd() == turn_at_ || lacksVertices()) turn();
      intake_.takeCell(row);
    }
    intake_.finishBatch();
  }

  void end() {
    checkCount("cells", plan_.schema.cell_count, intake_.cellsRead());
    checkCount("vertices", plan_.schema.vertex_count, core_.front.introduced());
    checkCount("labelled faces", plan_.schema.face_count, intake_.facesRead());
    if (release_.cellsGone() == 0) core_.stream_cells = static_cast<int64_t>(intake_.cellsRead());
    intake_.finalizeAll();
    resolveNew();
    intake_.checkFaces();
    if (parks()) {
      release_.takeBack();
      core_.holds_rest = true;
    }
    const Ledger now = ledger();
    decimate(budget_->lastGoal(now));
    if (now.written == 0 && !parks()) survey(now.read);
    selector_.reset();  // makes room for the output
    release_.write({0});
    release_.flush();
    if (tracer_) tracer_->flush();
    closeReport();
  }

  // An array that does not fit knows only of itself, and the next one would not fit either.
  template <class Work>
  void explainingBudget(Work work) {
    try {
      work();
    } catch (const Error& error) {
      const bool is_planned = options_.memory_bytes > 0;
      if (error.status() != Status::kNoMemory || !account_.refused() || !is_planned) throw;
      failForBudget(error.what());
    }
  }
  [[noreturn]] void failForBudget(const char* why) const {
    size_.fail(why, std::max(plan_.schema.front_cells, front_cells_), waitingBytes());
  }

  // Of vertices that came before their cells; where there are no cells yet, all may.
  double waitingBytes() const {
    auto waiting = static_cast<double>(intake_.waiting());
    if (intake_.cellsRead() == 0) waiting = std::max<double>(waiting, plan_.schema.vertex_count);
    return waiting * static_cast<double>(Core<S>::bytesPerVertex(plan_, options_));
  }

  std::unique_ptr<Selector> makeSelector() {
    switch (options_.mode) {
      case Mode::kPaper:
        return makeRandomSelector(core_, collapser_, account_);
      case Mode::kQueue:
        return makeQueueSelector(core_, collapser_, account_);
      case Mode::kSweep:
        break;
    }
    return makeSweepSelector(core_, account_);
  }

  static void checkCount(const char* what, int64_t announced, uint64_t came) {
    if (announced >= 0 && static_cast<uint64_t>(announced) != came)
      fail(Status::kBadData, "the stream announced %lld %s, %llu came",
           static_cast<long long>(announced), what, static_cast<unsigned long long>(came));
  }

  // Cells at the first turn. Where nothing is known of the bound, many passes find it; for a strong
  // reduction a part of the window will do for that, with enough behind the front. All of it stays
  // for the next turn.
  int64_t firstTurn() const {
    const int64_t front = plan_.schema.front_cells, all = plan_.schema.cell_count;
    const int64_t wanted = targetOf(plan_.schema, options_).cellsOf(all);
    const bool is_strong = isMoreThan(all, kStrongReduction, wanted);
    if (followsPaper(options_.mode) || knows_pilot_ || front < 0 || all <= capacity_ ||
        options_.error > 0 || !is_strong)
      return capacity_;
    return std::min(capacity_, std::max(capacity_ / 4, 5 * std::min(front, capacity_) / 2));
  }

  // Under a memory budget a mesh with more vertices to a cell than usual, as thin as a wall, fills
  // the vertices of the window before its cells; more of them would take what patches need. Where
  // a turn has just been made in vain they do, as long as there is memory.
  bool lacksVertices() {
    return options_.memory_bytes > 0 &&
           mesh().vertexEnd() + 4 > verticesOf(capacity_) + intake_.waiting() &&
           mesh().cellEnd() - resolved_cells_ >= capacity_ / kTurnsPerWindow;
  }

  // The window is full: simplify it and make room.
  void turn() {
    resolveNew();
    const Ledger before = ledger();
    decimate(budget_->goalOf(before));
    Ledger after = ledger();
    letGo(static_cast<uint32_t>(before.keep));
    after.front = release_.frontCells();
    budget_->learn(selector_->bound(), before, after,
                   static_cast<int64_t>(release_.cellsGone()) - before.written);
    core_.rescaled = 1;
    resolved_cells_ = mesh().cellEnd();
    core_.report.front_cells = std::max(core_.report.front_cells, before.front);
    makeRoom(before.front);
    tell(mesh().liveCells());
  }

  // All but so many cells.
  void letGo(uint32_t keep) {
    if (parks()) release_.park(keep);
    if (mesh().parkedCells() > mostParked(options_)) stopParking();
    if (!parks()) release_.write({keep, mostTraced()});
  }

  // More than the windows should leave: where little can be simplified that would be all there is.
  void stopParking() {
    release_.takeBack();
    budget_->stopParking();
    parked_times_ = 1;
  }

  void decimate(const Goal& goal) {
    selector_->decimate(goal, [&] { tell(goal.cells); });
  }

  // Everything that the cells read since the last turn made known.
  void resolveNew() {
    regions_.take(resolved_cells_, mesh().cellEnd());
    front_cells_ =
        resolver_.resolve(resolved_cells_, intake_.finalized(), intake_.finalizedCount());
    intake_.clearFinalized();
    if (error_sample_) error_sample_->take(resolved_cells_, mesh().cellEnd());
    if (options_.error > 0) error_sample_->limitError();
    resolved_cells_ = mesh().cellEnd();
  }

  Ledger ledger() {
    Ledger l;
    l.read = static_cast<int64_t>(intake_.cellsRead());
    l.written = static_cast<int64_t>(release_.cellsGone());
    l.live = mesh().liveCells();
    l.keep = keptCells();
    l.rescaled = core_.rescaled;
    l.flips = core_.flips();
    l.error_unit = core_.error_unit;
    l.error = core_.tally.error;
    l.error_limit = core_.error_limit;
    l.front = front_cells_;
    l.window = capacity_;
    return l;
  }

  // Cells that may stay in the window. Simplified ones wait there for their neighbours, and even
  // out what is simplified more and what less, but are loaded again at every turn: in a stream of
  // many windows, or one of which a pilot knows the parts, as many as the front has are enough. Not
  // for strong reductions, whose cells are large, nor up to an error, where no bound is passed to
  // make room.
  int64_t keptCells() const {
    const int64_t cells = plan_.schema.cell_count;
    const bool is_long = knows_parts_ || cells >= kLongStream * capacity_;
    const int64_t wanted = targetOf(plan_.schema, options_).cellsOf(cells);
    const bool is_mild = !isMoreThan(cells, kMildReduction, wanted);
    if (followsPaper(options_.mode) || options_.error > 0 || !is_long || !is_mild)
      return mostKept();
    return std::min(mostKept(), front_cells_ + std::max(front_cells_, capacity_ / 8));
  }

  // Half of a window of four fronts; where there are more no more.
  int64_t mostKept() const {
    const bool has_more = options_.window_cells == 0 && front_cells_ >= kWideFront;
    constexpr int64_t kKeptFronts = kFrontsPerWindow / 2;
    return has_more ? std::min(capacity_ / 2, kKeptFronts * front_cells_) : capacity_ / 2;
  }

  // Points of a map that may stay, beside those that the next turn makes: as many as a budget is
  // made for, or more where the account has memory left. Cells that went early for them would be
  // lost for the target.
  size_t mostTraced() const {
    if (!tracer_ || options_.memory_bytes == 0) return std::numeric_limits<size_t>::max();
    const double planned = kTracedPerCell * static_cast<double>(size_.foreseen(capacity_));
    const auto unused = static_cast<int64_t>(account_.limit() - account_.used());
    const int64_t left = std::max<int64_t>(unused - size_.heldBack(capacity_), 0);
    const double room = static_cast<double>(tracer_->pointRoom()) +
                        static_cast<double>(left) / static_cast<double>(Tracer<S>::pointBytes());
    return static_cast<size_t>(
        std::max(planned, room - static_cast<double>(core_.window.mesh.vertexEnd())));
  }

  // A window that was not asked for follows the front; one that was grows only when it is stuck.
  void makeRoom(int64_t front) {
    const int64_t live = mesh().liveCells();
    int64_t wanted = capacity_;
    if (options_.window_cells == 0) wanted = std::max(wanted, size_.forFront(front));
    const bool stuck = live > capacity_ - capacity_ / 8;
    if (stuck) wanted = std::max(wanted, live + live / 2);
    if (wanted > capacity_) {
      wanted = std::min(std::max(wanted, capacity_ + capacity_ / 4), affordable(stuck));
      if (wanted <= capacity_ && capacity_ - live < std::max<int64_t>(capacity_ / 64, 1)) {
        account_.failedOtherwise();  // what was refused before has been put up with
        size_.failForFront(capacity_, std::max(plan_.schema.front_cells, front_cells_),
                           waitingBytes());
      }
    }
    holdCells(std::max(wanted, capacity_));
  }

  // In the window; what is parked lies beside.
  void holdCells(int64_t cells) {
    turn_at_ = cells + mesh().parkedCells();
    if (const auto slots = static_cast<size_t>(turn_at_); slots > mesh().cellCapacity())
      core_.window.growCells(parks() ? slots + slots / 4 : slots);
    core_.report.window_cells = capacity_ = cells;
  }

  // The largest window that the budget allows; a stuck one may take half of what is left beyond.
  int64_t affordable(bool stuck) const {
    if (options_.memory_bytes == 0) return kMostCells;
    const auto left = static_cast<int64_t>((account_.limit() - account_.used()) / 2);
    const int64_t beyond = stuck ? capacity_ + left / size_.cellBytes() : 0;
    return std::min(std::max(size_.fitting(), beyond), kMostCells);
  }

  // All cells are in the window, in the order in which they came: a pilot for a second reading.
  void survey(int64_t read) {
    static constexpr size_t kParts = 64;
    std::vector<double> left(kParts + 1, 0);
    for (uint32_t c = 0; c < mesh().cellEnd(); ++c)
      if (mesh().isLive(c)) ++left[size_t{c} * kParts / static_cast<size_t>(read) + 1];
    for (size_t k = 1; k <= kParts; ++k) left[k] += left[k - 1];
    for (double& share : left) share /= std::max(left[kParts], 1.0);
    pilot_.bound = selector_->bound() * core_.error_unit;
    pilot_.share = left;
  }

  // What is left to do of what was read are the window's cells beyond its goal, and of them this.
  static constexpr double kLeftAfterReading = 0.8;
  void tell(int64_t goal) {
    if (!progress_) return;
    Progress p;
    p.cells_read = static_cast<int64_t>(intake_.cellsRead());
    p.cells_total = plan_.schema.cell_count;
    p.cells_written = static_cast<int64_t>(release_.cellsWritten());
    const auto left = static_cast<double>(std::max<int64_t>(mesh().liveCells() - goal, 0));
    const double done = static_cast<double>(p.cells_read) - kLeftAfterReading * left;
    if (p.cells_total > 0) {
      const double fraction = done / static_cast<double>(p.cells_total);
      p.fraction = told_ = std::clamp(fraction, told_, 1.0);  // a new goal never turns it back
    }
    p.phase = "simplify";
    progress_(p);
  }

  // What was done so far.
  void countInto(Report& r) const {
    const Tally& t = core_.tally;
    r.collapses = t.collapses;
    r.flips = t.flips;
    r.rejected_orientation = t.rejected_orientation;
    r.rejected_link = t.rejected_link;
    r.rejected_locked = t.rejected_locked;
    r.rejected_other = t.rejected_other;
    r.largest_error = t.largest_error;
    r.estimated_error = estimatedError();
    r.cells_in = static_cast<int64_t>(intake_.cellsRead());
    r.vertices_in = static_cast<int64_t>(core_.front.introduced());
    r.cells_out = static_cast<int64_t>(release_.cellsWritten());
    r.vertices_out = static_cast<int64_t>(release_.verticesWritten());
    const auto unit = static_cast<double>(core_.inverse_scale[0]);  // the cube of a small one is 0
    r.volume_in = core_.volume * unit * unit * unit;
    r.volume_out = release_.volumeWritten();
    r.front_width = core_.front.width();
    r.front_span = core_.front.span();
    if (plan_.schema.front_cells >= 0) r.front_cells = plan_.schema.front_cells;
    r.peak_window_bytes = account_.peak();
  }

  double estimatedError() const {
    return error_sample_ ? error_sample_->percent() : std::numeric_limits<double>::quiet_NaN();
  }

  void closeReport() {
    Report& r = core_.report;
    countInto(r);
    const std::string changes = core_.label_volumes.changesInWords();
    if (!changes.empty()) r.regions += "; " + changes;
    r.balance = inWords(core_.balance, core_.interfaces, plan_.schema.fields);
    const std::string lone = intake_.loneValues().inWords(metric_.ranges());
    if (!lone.empty()) r.balance += (r.balance.empty() ? "" : "; ") + lone;
    tell(0);
    const Target target = targetOf(plan_.schema, options_);
    const bool by_count = target.countsCells();
    r.target_cells = by_count ? target.cellsOf(r.cells_in) : 0;
    if (core_.tally.error_reached)
      r.reached = "error";
    else if (by_count && r.cells_out <= r.target_cells)
      r.reached = target.cells > 0 && std::min(target.cells, r.cells_in) == r.target_cells
                      ? "cells"
                      : "ratio";
    else if (by_count)
      r.limited_by = missInWords(core_);
  }

  const Plan plan_;
  const SimplifyOptions options_;
  const ProgressFunction& progress_;
  Account account_;
  const WindowSize size_;
  int64_t capacity_, turn_at_;  // cells
  uint32_t resolved_cells_ = 0;
  int64_t front_cells_ = 0;  // when resolved
  Pilot pilot_;
  double told_ = 0;  // the last fraction of the progress
  Core<S> core_;
  std::optional<Tracer<S>> tracer_;
  std::optional<ErrorSample<S>> error_sample_;
  bool knows_pilot_, knows_parts_;
  double parked_times_;  // above 1: the windows' cells are parked
  std::unique_ptr<Budget> budget_;
  Intake<S> intake_;
  Regions<S> regions_;
  Metric<S> metric_;
  Resolver<S> resolver_;
  Collapser<Window<S>> collapser_;
  std::unique_ptr<Selector> selector_;
  Release<S> release_;
};

// A budget that is too small for the first arrays is explained, too.
template <class S>
std::unique_ptr<Simplifier::Engine> makeEngine(const Plan& plan, const SimplifyOptions& options,
                                               const Pilot& pilot, Sink& out, TraceSinks sinks,
                                               const ProgressFunction& progress) {
  try {
    return std::make_unique<WindowedEngine<S>>(plan, options, pilot, out, sinks, progress);
  } catch (const Error& error) {
    if (error.status() != Status::kNoMemory || options.memory_bytes == 0) throw;
    windowSize<S>(plan, options).fail(error.what(), plan.schema.front_cells, 0);
  }
}

}  // namespace

Simplifier::Simplifier(const SimplifyOptions& options, Sink& out, ProgressFunction progress)
    : options_(options), out_(out), progress_(std::move(progress)) {}

Simplifier::~Simplifier() = default;

// What is traced has memory of its own, which only a budget plans for.
void Simplifier::begin(const Schema& schema) {
  if (!sinks_.any()) options_ = planned(schema, options_);
  Plan plan = makePlan(schema, options_);
  plan.traces_vertices = sinks_.any();
  plan.traces_points = sinks_.map != nullptr;
  const auto make = plan.double_window ? makeEngine<double> : makeEngine<float>;
  engine_ = make(plan, options_, pilot_, out_, sinks_, progress_);
  Schema smaller = schema;
  smaller.vertex_count = smaller.cell_count = smaller.face_count = -1;
  smaller.front_width = smaller.front_span = smaller.front_cells = -1;
  smaller.box_min.clear();
  smaller.box_max.clear();
  out_.begin(smaller);
  if (sinks_.map) sinks_.map->begin();
  if (sinks_.log) sinks_.log->begin(schema);
}

void Simplifier::put(const BatchView& batch) {
  engine_->put(batch);
}

void Simplifier::finish() {
  engine_->finish();
  if (sinks_.map) sinks_.map->finish();
  if (sinks_.log) sinks_.log->finish();
  out_.finish();
}

Pilot Simplifier::pilot() const {
  return engine_->pilot();
}

Report Simplifier::report() const {
  return engine_ ? engine_->report() : Report{};
}

}  // namespace tetstream
