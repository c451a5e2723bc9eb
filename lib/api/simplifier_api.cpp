// api: simplifiers of the public header.
#include "handles.h"
#include "memory.h"
#include "named_input.h"

using namespace tetstream;

// --------------------------------------------------------------------- what the functions share

static void closeRun(tetstream_simplifier& s) noexcept {
  s.output->onStop(nullptr);
  s.run.reset();
  s.map.reset();
  s.log.reset();
}

// The run's end, however it came about: its report stays with the handle, its memory goes.
static void dropRun(tetstream_simplifier& s) noexcept {
  if (!s.run) return;
  try {
    if (!s.reported) s.report = s.run->report();
  } catch (...) {
    // note: without memory for two sentences, the report of the last call stays.
  }
  closeRun(s);
}

// Runs a body that reads or writes the stream; what leaves it as an exception breaks the handle.
template <class Body>
static Status inStream(tetstream_simplifier& s, Body&& body) {
  const Busy busy(s);
  s.reported = false;
  try {
    return static_cast<Status>(statusOf(body));
  } catch (...) {
    dropRun(s);
    s.output->stop(State::kBroken);
    s.state = State::kBroken;
    throw;
  }
}

static void startRun(tetstream_simplifier& s, const ProgressFunction& progress) {
  const ProgressFunction watched = s.output->watchedBy(progress);
  s.output->start(s.options.temp_dir, s.map != nullptr);
  s.run = std::make_unique<SimplifyRun>(s.options, *s.output, watched);
  s.run->trace({s.map.get(), s.log.get()});
  s.output->onStop([&s] { dropRun(s); });
}

static Status endRun(tetstream_simplifier& s) {
  s.report = s.run->report();
  closeRun(s);
  s.output->complete();
  s.state = State::kFinished;
  return s.report.limited_by.empty() ? Status::kOk : Status::kTargetMissed;
}

static Status pull(tetstream_simplifier& s, tetstream_reader& reader) {
  ReaderUse use(reader);
  startRun(s, use.told(progressOf(s.progress, s.progress_user)));
  // The run goes before what it reads from, also after a failure.
  struct Scope {
    tetstream_simplifier& s;
    ~Scope() { dropRun(s); }
  };
  const Scope scope{s};
  Input& input = use.input(s.output->mustRound(use.schema()), s.options.temp_dir);
  readNamed(input, [&] { s.run->run(input); });
  use.done();
  return endRun(s);
}

static void push(tetstream_simplifier& s, const tetstream_batch& batch) {
  BatchView view = s.batches->view(batch);
  if (s.rounding) view = s.rounding->round(view);
  s.run->put(view);
}

// ------------------------------------------------------------------------------- the functions

tetstream_status tetstream_simplifier_create(const tetstream_options* options,
                                             tetstream_writer* writer,
                                             tetstream_simplifier** simplifier) {
  return guardCreate(__func__, simplifier, [&](tetstream_simplifier& s) {
    needPlace(writer, "writer");
    outputOf(*writer).needReady();
    keepOptions(s, options);
    s.output = writer->output;
  });
}

void tetstream_simplifier_destroy(tetstream_simplifier* simplifier) {
  const Undisturbed undisturbed;
  if (simplifier && simplifier->state == State::kRunning) {
    closeRun(*simplifier);
    simplifier->output->stop(State::kBroken);
  }
  destroy(simplifier);
}

tetstream_status tetstream_simplifier_set_progress(tetstream_simplifier* simplifier,
                                                   tetstream_progress_callback progress,
                                                   void* user) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    s.progress = progress;
    s.progress_user = user;
  });
}

tetstream_status tetstream_simplifier_run(tetstream_simplifier* simplifier,
                                          tetstream_reader* reader) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    needUnread(reader, "reader");
    s.output->needReady();
    return inStream(s, [&] { return pull(s, *reader); });
  });
}

tetstream_status tetstream_simplifier_begin(tetstream_simplifier* simplifier,
                                            const tetstream_stream_info* info) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kReady);
    const tetstream_stream_info stream = readStruct(info, "info");
    const Schema schema = schemaOf(stream);
    s.output->needReady();
    return inStream(s, [&] {
      startRun(s, progressOf(s.progress, s.progress_user));
      s.batches.emplace(schema);
      if (s.output->mustRound(schema)) s.rounding.emplace(schema);
      s.run->begin(s.rounding ? s.rounding->schema() : schema,
                   (stream.flags & TETSTREAM_STREAM_INDEXED) != 0);
      s.state = State::kRunning;
    });
  });
}

tetstream_status tetstream_simplifier_push(tetstream_simplifier* simplifier,
                                           const tetstream_batch* batch) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kRunning);
    s.output->needRunning();
    const tetstream_batch events = readStruct(batch, "batch");
    return inStream(s, [&] { push(s, events); });
  });
}

tetstream_status tetstream_simplifier_finish(tetstream_simplifier* simplifier) {
  return guard(__func__, simplifier, [&](tetstream_simplifier& s) {
    needState(s, State::kRunning);
    s.output->needRunning();
    return inStream(s, [&] {
      s.run->finish();
      return endRun(s);
    });
  });
}

static tetstream_report publicReport(const Report& report) {
  tetstream_report out = {};
  out.cells_in = report.cells_in;
  out.vertices_in = report.vertices_in;
  out.cells_out = report.cells_out;
  out.vertices_out = report.vertices_out;
  out.target_cells = report.target_cells;
  out.window_cells = report.window_cells;
  out.front_width = report.front_width;
  out.front_span = report.front_span;
  out.front_cells = report.front_cells;
  out.collapses = report.collapses;
  out.rejected_orientation = report.rejected_orientation;
  out.rejected_link = report.rejected_link;
  out.rejected_locked = report.rejected_locked;
  out.rejected_other = report.rejected_other;
  out.locked_cells = report.locked_cells;
  out.unused_vertices = report.unused_vertices;
  out.largest_error = report.largest_error;
  out.seconds = report.seconds;
  out.peak_window_bytes = report.peak_window_bytes;
  out.peak_resident_bytes = peakResidentBytes();
  out.regions = report.regions.c_str();
  out.limited_by = report.limited_by.c_str();
  out.estimated_error = report.estimated_error;
  out.reached = report.reached.c_str();
  out.order = report.order.c_str();
  out.balance = report.balance.c_str();
  out.volume_in = report.volume_in;
  out.volume_out = report.volume_out;
  return out;
}

tetstream_status tetstream_simplifier_get_report(const tetstream_simplifier* simplifier,
                                                 tetstream_report* report) {
  return guard(__func__, simplifier, [&](const tetstream_simplifier& s) {
    checkStruct(report, "report");
    // What it points to stays while the stream does not go on.
    if (s.run && !s.reported) s.report = s.run->report();
    s.reported = true;
    writeStruct(report, publicReport(s.report));
  });
}

const char* tetstream_simplifier_message(const tetstream_simplifier* simplifier) {
  return messageOf(simplifier);
}
