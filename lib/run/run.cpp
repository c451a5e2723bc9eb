// run: the page that joins the pieces: reader -> [layout] -> simplifier -> writer.
#include "run.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "front_meter.h"
#include "ordering.h"
#include "orders.h"
#include "pilot_run.h"
#include "reading.h"
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

RunOptions withTasks(RunOptions options, const Tasks* tasks) {
  options.simplify.tasks = tasks;
  return options;
}

// A reading of a stream, as a part of all the time, from 0 to 1.
struct Stage {
  const char* phase;
  double begin, end;
};

// use(batch, progress) for all batches.
template <class Use>
void readAll(Source& source, const Stage& stage, const ProgressFunction& progress, Use use) {
  Progress p;
  p.cells_total = source.schema().cell_count;
  p.phase = stage.phase;
  for (BatchView batch; source.next(batch);) {
    use(batch, p);
    p.cells_read += static_cast<int64_t>(batch.cell_count);
    if (p.cells_total > 0) {
      const double share = static_cast<double>(p.cells_read) / static_cast<double>(p.cells_total);
      p.fraction = stage.begin + (stage.end - stage.begin) * std::min(1.0, share);
    }
    if (progress) progress(p);
  }
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
        behind(overlaps(options, tasks) && !out.staysWithCaller()
                   ? std::make_unique<WriteBehind>(out, tasks)
                   : nullptr),
        simplifier(options.simplify, behind ? *behind : out,
                   [this](const Progress& p) { tell(p); }) {}

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
  double order_share = 0;  // of the time, of ordering that is done
  double pilot_share = 0;  // of the time, of a pilot that is done
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
    const bool is_traced = options.origins;
    if (!is_traced)
      options.simplify = Simplifier::planned(stream.source().schema(), options.simplify);
    PilotRun pilot(options, tasks, stream, [this](const Progress& p) { tell(p); });
    if (const std::optional<Pilot> found = pilot.run()) simplifier.follow(*found);
    pilot_share = pilot.share();
    const auto before = readAhead(stream.source(), stream, options, tasks);
    copyStream(before ? *before : stream.source(), simplifier);
    close();
    report.unused_vertices += stream.unusedVertices();
    report.vertices_in += stream.unusedVertices();
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
  readAll(stream.source(), {"convert", stream.share(), 1}, progress,
          [&](const BatchView& batch, Progress& p) {
            if (!stream.isOrdered()) checker.put(batch);
            out.put(batch);
            report.vertices += static_cast<int64_t>(batch.vertex_count);
            report.cells = p.cells_written += static_cast<int64_t>(batch.cell_count);
          });
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
  StreamFacts facts(stream.source().schema());
  readAll(stream.source(), {"inspect", stream.share(), 1}, progress,
          [&](const BatchView& batch, Progress&) { facts.put(batch); });
  facts.finish();
  const Schema schema = facts.schema();
  SimplifyOptions simplify;  // the option `window` is one of simplifying alone
  simplify.memory_bytes = options.simplify.memory_bytes;
  return {schema,
          facts.figures(),
          Simplifier::windowCells(schema, simplify),
          facts.notFinite(),
          stream.unusedVertices(),
          facts.faceLabels()};
}

// The schema with the box and the counts, from a first reading if need be: a half of what is left.
static Schema sweptSchema(Source& source, double* share, const ProgressFunction& progress) {
  if (SweepViews::serves(source.schema())) return source.schema();
  const std::unique_ptr<Source> first = source.again(Part::kAll);
  if (!first)
    fail(Status::kUnsupported,
         "a sweep is drawn to the measure of the mesh's box and number of cells, which this stream "
         "tells only at its end: convert it to .tets first");
  StreamFacts facts(first->schema());
  const double before = std::exchange(*share, (1 + *share) / 2);
  readAll(*first, {"measure", before, *share}, progress,
          [&](const BatchView& batch, Progress&) { facts.put(batch); });
  facts.finish();
  return facts.schema();
}

Diagram readDiagram(Input& input, DiagramSize size, bool with_sweep, const RunOptions& options,
                    const ProgressFunction& progress) {
  Ordering stream(input, options, progress);
  const Schema& schema = stream.source().schema();
  Diagram diagram;
  double share = stream.share();
  if (with_sweep)
    diagram.sweep = std::make_unique<SweepViews>(sweptSchema(stream.source(), &share, progress));
  diagram.layout = std::make_unique<LayoutDiagram>(schema, size.columns, size.rows);
  readAll(stream.source(), {"diagram", share, 1}, progress, [&](const BatchView& batch, Progress&) {
    diagram.layout->put(batch);
    if (diagram.sweep) diagram.sweep->put(batch);
  });
  diagram.layout->finish();
  if (diagram.sweep) diagram.sweep->finish();
  return diagram;
}

}  // namespace tetstream
