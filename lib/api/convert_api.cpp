// api: what the public header offers without simplifying.
#include "handles.h"
#include "named_input.h"
#include "registry.h"

using namespace tetstream;

static void noteUnused(tetstream_reader& reader, int64_t vertices) {
  if (vertices > 0)
    reader.notes.add(
        textOf("vertices that are in no cell, left out: %lld", static_cast<long long>(vertices)));
}

// From the reader to the output, which is started and stays incomplete after a failure.
static LayoutReport convertInto(Output& output, tetstream_reader& reader, const RunOptions& options,
                                const ProgressFunction& progress) {
  ReaderUse use(reader);
  const ProgressFunction watched = output.watchedBy(use.told(progress));
  output.start(options.temp_dir);
  Input& input = use.input(output.mustRound(use.schema()), options.temp_dir);
  LayoutReport report = readNamed(input, [&] { return convert(input, output, options, watched); });
  use.done();
  return report;
}

static tetstream_layout_report publicReport(const LayoutReport& report) {
  tetstream_layout_report out = {};
  out.order = report.order.c_str();
  out.vertices = report.vertices;
  out.cells = report.cells;
  out.unused_vertices = report.unused_vertices;
  out.front_width = report.front_width;
  out.front_span = report.front_span;
  out.front_cells = report.front_cells;
  out.temporary_bytes = report.temporary_bytes;
  out.seconds = report.seconds;
  return out;
}

static void copyTo(tetstream_writer& w, tetstream_reader* reader, RunOptions run,
                   RunOptions::Auto automatic, const ProgressFunction& progress) {
  needUnread(reader, "reader");
  Output& output = outputOf(w);
  output.needReady();
  run.automatic = automatic;
  const Busy busy(w);
  try {
    w.laid_out = convertInto(output, *reader, run, progress);
    if (automatic == RunOptions::Auto::kKeeps)  // a layout's report has it
      noteUnused(*reader, w.laid_out.unused_vertices);
    output.complete();
  } catch (...) {
    output.stop(State::kBroken);
    throw;
  }
}

tetstream_status tetstream_convert(tetstream_reader* reader, tetstream_writer* writer,
                                   const tetstream_options* options,
                                   tetstream_progress_callback progress, void* user) {
  return guard(__func__, writer, [&](tetstream_writer& w) {
    copyTo(w, reader, runOptionsOf(options), RunOptions::Auto::kKeeps, progressOf(progress, user));
  });
}

tetstream_status tetstream_layout(tetstream_reader* reader, tetstream_writer* writer,
                                  const tetstream_options* options,
                                  tetstream_progress_callback progress, void* user,
                                  tetstream_layout_report* report) {
  return guard(__func__, writer, [&](tetstream_writer& w) {
    if (report) checkStruct(report, "report");
    copyTo(w, reader, runOptionsOf(options), RunOptions::Auto::kNarrows,
           progressOf(progress, user));
    if (report) writeStruct(report, publicReport(w.laid_out));
  });
}

static tetstream_front_info publicFront(const Inspection& found) {
  const DiagramFigures& figures = found.figures;
  tetstream_front_info out = {};
  out.width = figures.front.width;
  out.span = figures.front.span;
  out.cells = figures.front.cells;
  out.mean_width = figures.mean_width;
  out.mean_span = figures.mean_span;
  out.mean_life = figures.mean_life;
  out.longest_life = figures.longest_life;
  out.window_cells = found.window_cells;
  return out;
}

tetstream_status tetstream_inspect(tetstream_reader* reader, const tetstream_options* options,
                                   tetstream_progress_callback progress, void* user,
                                   tetstream_stream_info* info) {
  return guard(__func__, reader, [&](tetstream_reader& r) {
    checkStruct(info, "info");
    RunOptions run = runOptionsOf(options);
    run.automatic = RunOptions::Auto::kKeeps;
    ReaderUse use(r);
    const bool indexed = (r.known->info().flags & TETSTREAM_STREAM_INDEXED) != 0;
    Input& input = use.input(false, run.temp_dir);
    const Inspection found =
        readNamed(input, [&] { return inspect(input, run, use.told(progressOf(progress, user))); });
    noteUnused(r, found.unused_vertices);
    r.inspected = std::make_unique<const PublicSchema>(found.schema, indexed);
    for (size_t f = 0; f < found.not_finite.size(); ++f)
      if (found.not_finite[f] > 0)
        r.notes.add(textOf("values of the field \"%s\" that are not finite: %lld",
                           found.schema.fields[f].name.c_str(),
                           static_cast<long long>(found.not_finite[f])));
    r.front = publicFront(found);
    r.face_labels.clear();
    for (const auto& [label, figures] : found.face_labels.labels())
      r.face_labels.push_back({sizeof(tetstream_face_label_info), label, figures.faces});
    writeStruct(info, r.inspected->info());
    use.done();
  });
}

tetstream_status tetstream_format_at(int32_t index, const char** name, const char** extensions,
                                     const char** text, int32_t* can_read, int32_t* can_write) {
  return guard([&] {
    size_t count = 0;
    const Format* rows = formats(&count);
    if (index < 0 || static_cast<size_t>(index) >= count)
      fail(Status::kBadArgument, "there is no format %d", index);
    const Format& row = rows[index];
    if (name) *name = row.name;
    if (extensions) *extensions = row.extensions;
    if (text) *text = row.text;
    if (can_read) *can_read = row.open != nullptr;
    if (can_write) *can_write = row.create != nullptr;
  });
}
