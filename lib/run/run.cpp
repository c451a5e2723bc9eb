// run: the page that joins the pieces: reader -> [layout] -> simplifier -> writer.
#include "run.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "front_meter.h"
#include "ordering.h"
#include "orders.h"
#include "read_ahead.h"
#include "sampler.h"
#include "simplifier.h"
#include "spooled_mesh.h"
#include "status.h"
#include "stream_facts.h"
#include "tasks.h"
#include "write_behind.h"

namespace tetstream {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// A pilot takes this share of the time of the run that it serves.
constexpr double kPilotShare = 0.5;
constexpr int64_t kPilotCells = 1 << 18;
// Larger meshes are sampled, which takes this share.
constexpr double kSampleShare = 0.1;
// A stream of so many cells, which most files hold in one piece, is not read ahead.
constexpr int64_t kReadAtOnce = 1 << 14;

class Nowhere final : public Sink {
 public:
  void begin(const Schema&) override {}
  void put(const BatchView&) override {}
  void finish() override {}
};

RunOptions withTasks(RunOptions options, const Tasks* tasks) {
  options.simplify.tasks = tasks;
  return options;
}

// `before`: the share of the time that ordering took.
void tellCells(Progress& p, size_t more, double before, const ProgressFunction& progress) {
  p.cells_read += static_cast<int64_t>(more);
  if (p.cells_total > 0)
    p.fraction = before + (1 - before) * std::min(1.0, static_cast<double>(p.cells_read) /
                                                           static_cast<double>(p.cells_total));
  if (progress) progress(p);
}

}  // namespace

size_t threadsOf(const RunOptions& options) {
  if (options.threads > 0) return static_cast<size_t>(options.threads);
  return options.workers ? options.workers->threads() + 1 : coresToUse();
}

struct SimplifyRun::State {
  State(const RunOptions& the_options, Sink& out, ProgressFunction the_progress)
      : tasks(threadsOf(the_options), the_options.workers),
        options(withTasks(the_options, &tasks)),
        progress(std::move(the_progress)),
        behind(overlaps() && !out.staysWithCaller() ? std::make_unique<WriteBehind>(out, tasks)
                                                    : nullptr),
        simplifier(options.simplify, behind ? *behind : out,
                   [this](const Progress& p) { tell(p); }) {}

  // A memory budget is for one batch on its way, as it is for a single patch.
  bool overlaps() const { return tasks.threads() > 1 && options.simplify.memory_bytes == 0; }

  // The stream, read ahead where that may be, and takes longer than another thread to begin.
  std::unique_ptr<ReadAhead> ahead(Source& stream, const Ordering& ordering) const {
    const int64_t cells = stream.schema().cell_count;
    const bool is_short = cells >= 0 && cells <= kReadAtOnce;
    if (!overlaps() || is_short || ordering.staysWithCaller()) return nullptr;
    if (!ordering.waiting()) return std::make_unique<ReadAhead>(stream, tasks);
    // To threads that the caller brings none of ours are added; and two leave no core to who is at
    // the other end as it is.
    if (options.workers || tasks.threads() == 2) return nullptr;
    return std::make_unique<ReadAhead>(stream, ordering.waiting());
  }

  // Of two errors the one that came first in the stream's order: what was put before the other is
  // written first.
  template <class Step>
  void inOrder(Step step) {
    try {
      step();
    } catch (...) {
      if (behind) behind->settle();
      throw;
    }
  }

  // The simplifier's progress after the part that ordering took.
  void tell(Progress p) {
    if (!progress) return;
    if (p.fraction >= 0) p.fraction = pilot_share + (1 - pilot_share) * p.fraction;
    if (p.fraction >= 0) p.fraction = order_share + (1 - order_share) * p.fraction;
    progress(p);
  }

  Tasks tasks;
  RunOptions options;
  ProgressFunction progress;
  double order_share = 0;   // of the time, of ordering that is done
  double pilot_share = 0;   // of the time, of a pilot that is done
  double sample_share = 0;  // of the time, of what is read for a sample
  std::unique_ptr<WriteBehind> behind;
  Simplifier simplifier;
  std::unique_ptr<SpooledMesh> collector;
  Clock::time_point start;
  std::string order;  // in words
  Report report;
  bool is_done = false;

  void simplify(Input& input) {
    Ordering stream(input, options, progress,
                    Simplifier::measuredFields(input.schema(), options.simplify));
    order_share = stream.share();
    order = stream.chosen();
    readBefore(stream);
    const auto before = ahead(stream.source(), stream);
    copyStream(before ? *before : stream.source(), simplifier);
    close();
    report.unused_vertices += stream.unusedVertices();
    report.vertices_in += stream.unusedVertices();
  }
  // Looks at the stream before it is simplified, where that is worth its time: at a mesh larger
  // than its window.
  void readBefore(Ordering& stream) {
    const SimplifyOptions& o = options.simplify;
    const Schema& schema = stream.source().schema();
    const int64_t cells = schema.cell_count, window = Simplifier::windowCells(schema, o);
    if (followsPaper(o.mode) || o.pilot != PilotUse::kAuto || cells <= window) return;
    if (o.memory_bytes == 0 && cells <= kPilotCells)
      flyWhole(stream);
    else if (Sampler::serves(schema, o) && Sampler::pays(schema, o))
      sample(stream);
  }
  void flyWhole(Ordering& stream) {
    const std::unique_ptr<Source> again = stream.source().again(Part::kAll);
    if (!again) return;
    const auto before = ahead(*again, stream);
    Source& source = before ? *before : *again;
    SimplifyOptions whole = options.simplify;
    whole.window_cells = source.schema().cell_count;
    Nowhere nowhere;
    Simplifier pilot(whole, nowhere, [this](Progress p) {
      p.phase = "pilot";
      p.cells_written = 0;
      if (p.fraction >= 0) p.fraction *= kPilotShare;
      tell(p);
    });
    copyStream(source, pilot);
    simplifier.follow(pilot.pilot());
    pilot_share = kPilotShare;
  }
  // Of a long stream, which is read twice for it. What is wrong with it is told as it is found
  // from end to end.
  void sample(Ordering& stream) {
    if (overlaps() && !stream.staysWithCaller()) {
      try {
        sampleBy(tasks.threads(), stream);
        return;
      } catch (const Error& error) {
        const Status status = error.status();
        if (status != Status::kBadData && status != Status::kIo && status != Status::kNoMemory)
          throw;
      }
    }
    sampleBy(1, stream);
  }
  void sampleBy(size_t threads, Ordering& stream) {
    Sampler sampler(stream.source().schema(), options.simplify);
    const size_t most = std::min(threads, sampler.mostStretches());
    std::vector<Stretch> stretches = stretchesOf(stream, Part::kPositions, most, 0);
    if (stretches.empty()) return;
    sampler.countInStretches(stretches.size());
    const auto vertices = static_cast<double>(stream.source().schema().vertex_count);
    readSampling(stream, stretches, 0, [&](const BatchView& batch, size_t stretch) {
      sampler.count(batch, stretch);
      return static_cast<double>(batch.vertex_count) / vertices;
    });
    stretches = stretchesOf(stream, Part::kAll, most, sampler.reach());
    if (stretches.empty()) return;
    std::vector<Stretch::Begin> begins;
    begins.reserve(stretches.size());
    for (const Stretch& stretch : stretches) begins.push_back(stretch.begin);
    sampler.takeBricks(begins);
    const auto cells = static_cast<double>(stream.source().schema().cell_count);
    readSampling(stream, stretches, kSampleShare / 2, [&](const BatchView& batch, size_t stretch) {
      sampler.put(batch, stretch);
      return static_cast<double>(batch.cell_count) / cells;
    });
    try {
      simplifier.follow(sampler.fly());
    } catch (const Error& error) {  // the run itself will say where, and what would do
      if (error.status() != Status::kBadData && error.status() != Status::kNoMemory) throw;
    }
    pilot_share = kSampleShare;
  }
  // For that many threads, or one of all; none where the stream can be read but once.
  std::vector<Stretch> stretchesOf(Ordering& stream, Part part, size_t most, uint64_t before) {
    Source& source = stream.source();
    std::vector<Stretch> stretches;
    if (most > 1) stretches = source.againInStretches(part, most, before);
    if (!stretches.empty()) return stretches;
    if (std::unique_ptr<Source> all = source.again(part)) stretches.push_back({std::move(all), {}});
    return stretches;
  }
  // use(batch, stretch) returns how much of the stream has been read with it, of 1.
  template <class Use>
  void readSampling(Ordering& stream, std::vector<Stretch>& stretches, double share_before,
                    Use use) {
    const size_t count = stretches.size();
    const auto before = count == 1 ? ahead(*stretches[0].source, stream) : nullptr;
    std::atomic<size_t> end = count;  // of no use is what comes after a part that failed
    const std::thread::id caller = std::this_thread::get_id();
    tasks.forParts(count, [&](size_t k) {
      Source& source = before ? *before : *stretches[k].source;
      BatchView batch;
      double part = 0;
      try {
        while (k < end && source.next(batch)) {
          part += static_cast<double>(count) * use(batch, k);
          if (std::this_thread::get_id() != caller) continue;
          tellSampling(share_before, std::min(part, 1.0), source.schema().cell_count);
        }
      } catch (...) {
        for (size_t known = end; k < known && !end.compare_exchange_weak(known, k);) {
        }
        throw;
      }
    });
  }
  void tellSampling(double share_before, double part, int64_t cells) {
    Progress p;
    p.phase = "pilot";
    p.cells_total = cells;
    p.cells_read = static_cast<int64_t>(part * static_cast<double>(cells));
    // Never back: the caller's thread may read several parts, and all once more.
    p.fraction = sample_share = std::max(sample_share, share_before + kSampleShare / 2 * part);
    tell(p);
  }
  Report soFar() const {
    Report r = simplifier.report();
    r.seconds = secondsSince(start);
    r.order = order;
    return r;
  }
  void close() {
    report = soFar();
    is_done = true;
  }
};

SimplifyRun::SimplifyRun(const RunOptions& options, Sink& out, ProgressFunction progress)
    : state_(std::make_unique<State>(options, out, std::move(progress))) {}

SimplifyRun::~SimplifyRun() = default;

void SimplifyRun::trace(TraceSinks sinks) {
  state_->options.origins = sinks.any();
  state_->simplifier.trace(sinks);
}

void SimplifyRun::run(Input& input) {
  state_->start = Clock::now();
  state_->inOrder([&] { state_->simplify(input); });
}

void SimplifyRun::begin(const Schema& schema, bool indexed) {
  state_->start = Clock::now();
  if (indexed) {
    state_->collector = std::make_unique<SpooledMesh>(schema, state_->options.temp_dir);
  } else {
    state_->order = Ordering::wordsForNone(schema);
    state_->simplifier.begin(schema);
  }
}

void SimplifyRun::put(const BatchView& batch) {
  if (state_->collector)
    state_->collector->put(batch);
  else
    state_->inOrder([&] { state_->simplifier.put(batch); });
}

void SimplifyRun::finish() {
  if (state_->collector) {
    state_->collector->finish();
    Input input;
    input.indexed = std::move(state_->collector);
    input.stays_with_caller = false;
    state_->inOrder([&] { state_->simplify(input); });
  } else {
    state_->inOrder([&] { state_->simplifier.finish(); });
    state_->close();
  }
}

Report SimplifyRun::report() const {
  return state_->is_done ? state_->report : state_->soFar();
}

// What is copied or looked at needs no window, and orders by place take little longer in little
// memory: 20 million cells peak at 112 MB with this, and at 463 in three quarters of the time with
// the default of ordering. Orders that make a graph of the mesh become better ones by more.
static RunOptions inLittleMemory(const RunOptions& options) {
  constexpr int64_t kMemory = int64_t{128} << 20;
  const Order order = orderOf(options.order);
  const bool by_graph = order == Order::kBreadthFirst || order == Order::kSpectral ||
                        options.automatic == RunOptions::Auto::kNarrows;
  RunOptions little = options;
  if (little.simplify.memory_bytes == 0 && !by_graph) little.simplify.memory_bytes = kMemory;
  return little;
}

LayoutReport convert(Input& input, Sink& out, const RunOptions& options,
                     const ProgressFunction& progress) {
  const Clock::time_point start = Clock::now();
  Ordering stream(input, inLittleMemory(options), progress);
  const Schema& schema = stream.source().schema();
  out.begin(schema);
  // What is ordered here is sound; what comes as a stream is checked before anybody else sees it.
  Account account;
  FrontMeter checker(account);
  LayoutReport report;
  BatchView batch;
  Progress p;
  p.cells_total = schema.cell_count;
  p.phase = "convert";
  while (stream.source().next(batch)) {
    if (!stream.isOrdered()) checker.put(batch);
    out.put(batch);
    report.vertices += static_cast<int64_t>(batch.vertex_count);
    report.cells = p.cells_written += static_cast<int64_t>(batch.cell_count);
    tellCells(p, batch.cell_count, stream.share(), progress);
  }
  out.finish();
  report.order = stream.chosen();
  report.front_width = stream.isOrdered() ? schema.front_width : checker.statistics().width;
  report.front_span = stream.isOrdered() ? schema.front_span : checker.statistics().span;
  report.front_cells = stream.isOrdered() ? schema.front_cells : checker.statistics().cells;
  report.unused_vertices = stream.unusedVertices();
  report.temporary_bytes = stream.diskBytes();
  report.seconds = secondsSince(start);
  return report;
}

Inspection inspect(Input& input, const RunOptions& options, const ProgressFunction& progress) {
  Ordering stream(input, inLittleMemory(options), progress);
  const int64_t total = stream.source().schema().cell_count;
  StreamFacts facts(stream.source().schema());
  BatchView batch;
  Progress p;
  p.cells_total = total;
  p.phase = "inspect";
  while (stream.source().next(batch)) {
    facts.put(batch);
    tellCells(p, batch.cell_count, stream.share(), progress);
  }
  facts.finish();
  const Schema schema = facts.schema();
  SimplifyOptions simplify;
  simplify.window_cells = options.simplify.window_cells;
  simplify.memory_bytes = options.simplify.memory_bytes;
  for (const Column& c : schema.fields)  // carried: there may be too many to be measured
    if (isFloat(c.type)) simplify.fields.emplace_back(c.name, 0);
  return {schema, facts.figures(), Simplifier::windowCells(schema, simplify), facts.notFinite(),
          facts.faceLabels()};
}

// The schema with the box and the counts, from a first reading if need be.
static Schema sweptSchema(Source& source, const ProgressFunction& progress) {
  if (SweepViews::serves(source.schema())) return source.schema();
  const std::unique_ptr<Source> first = source.again(Part::kAll);
  if (!first)
    fail(Status::kUnsupported,
         "a sweep is drawn to the measure of the mesh's box and number of cells, which this stream "
         "tells only at its end: convert it to .tets first");
  StreamFacts facts(first->schema());
  BatchView batch;
  Progress p;
  p.phase = "measure";
  while (first->next(batch)) {
    facts.put(batch);
    tellCells(p, batch.cell_count, 0, progress);
  }
  facts.finish();
  return facts.schema();
}

Diagram readDiagram(Input& input, DiagramSize size, bool with_sweep, const RunOptions& options,
                    const ProgressFunction& progress) {
  Ordering stream(input, options, progress);
  const Schema& schema = stream.source().schema();
  Diagram diagram;
  if (with_sweep)
    diagram.sweep = std::make_unique<SweepViews>(sweptSchema(stream.source(), progress));
  diagram.layout = std::make_unique<LayoutDiagram>(schema, size.columns, size.rows);
  BatchView batch;
  Progress p;
  p.cells_total = schema.cell_count;
  p.phase = "diagram";
  while (stream.source().next(batch)) {
    diagram.layout->put(batch);
    if (diagram.sweep) diagram.sweep->put(batch);
    tellCells(p, batch.cell_count, stream.share(), progress);
  }
  diagram.layout->finish();
  if (diagram.sweep) diagram.sweep->finish();
  return diagram;
}

}  // namespace tetstream
