// api: readers of the public header.
#include <sys/stat.h>

#include <utility>

#include "cells_to_points.h"
#include "compressed_bytes.h"
#include "descriptor_name.h"
#include "generate.h"
#include "handles.h"
#include "memory_source.h"
#include "registry.h"
#include "tasks.h"
#include "time_steps.h"

using namespace tetstream;

static std::string textOrEmpty(const char* text) {
  return text ? text : "";
}

static void takeCellsToPoints(Input& input, const std::string& temp_dir, const std::string& name) {
  if (input.stream)
    fail(Status::kUnsupported,
         "%s: of a stream, cell arrays do not become fields (option cells-to-points)",
         name.c_str());
  input.indexed = cellsToPoints(std::move(input.indexed), temp_dir);
}

// Where a file has floats, but none that a simplification could follow.
static std::string unmeasuredNote(const Input& input) {
  const Schema& schema = input.schema();
  std::string names;
  for (const Column& column : schema.cell_data)
    if (isFloat(column.type)) names += (names.empty() ? "\"" : ", \"") + column.name + "\"";
  const bool any_field = std::any_of(schema.fields.begin(), schema.fields.end(),
                                     [](const Column& field) { return isFloat(field.type); });
  if (any_field || names.empty()) return "";
  return "no field at points is there to be followed, only cell arrays: " + names +
         (input.indexed ? " (option cells-to-points, --cells-to-points)" : "");
}

static ByteWatch::Tell openingTold(const tetstream_options* settings) {
  if (!settings || !settings->values->progress()) return {};
  return [tell = settings->values->progress()](double fraction) {
    Progress progress;
    progress.phase = "open";
    progress.fraction = fraction;
    tell(progress);
  };
}

static ReadOptions readOptionsOf(const RunOptions& run) {
  ReadOptions options;
  options.temp_dir = run.temp_dir;
  options.split = run.split == "yes";
  options.recover = run.recover == "yes";
  options.join = run.join_points == "yes"  ? PointJoining::kYes
                 : run.join_points == "no" ? PointJoining::kNo
                                           : PointJoining::kAuto;
  options.step = parseStep(run.step);
  return options;
}

// What was asked for and this input does not have.
static void checkUses(const Input& input, const ReadOptions& options, const std::string& name) {
  if (options.join == PointJoining::kYes && input.stream)
    fail(Status::kUnsupported, "%s: points of streams are not joined (option join-points)",
         name.c_str());
  if (options.step > 0 && !input.has_steps)
    fail(Status::kUnsupported,
         "%s: there is no time step %lld (option step, --step): there are none to choose from",
         name.c_str(), static_cast<long long>(options.step));
}

// Opens the bytes as `format` and reads the header. `path` where they are a file's.
static void openBytes(tetstream_reader& reader, const Format& format,
                      std::unique_ptr<ByteSource> bytes, const tetstream_options* settings,
                      const std::string& path = "") {
  if (!format.open)
    fail(Status::kUnsupported, "the format \"%s\" is written, but not read", format.name);
  const RunOptions run = runOptionsOf(settings);
  ReadOptions options = readOptionsOf(run);
  if (options.recover && !format.recovers)
    fail(Status::kUnsupported, "%s: only .tets files can be recovered, not those of format \"%s\"",
         bytes->name().c_str(), format.name);
  // As in a run, whose option `memory` is for one thread.
  if (settings) reader.workers = settings->values->workers();
  const size_t threads = run.simplify.memory_bytes > 0 ? 1 : threadsOf(run);
  reader.tasks = std::make_unique<const Tasks>(threads, run.workers);
  options.threads.tasks = reader.tasks.get();
  options.note = [&reader](const std::string& note) { reader.notes.add(note); };
  const ByteWatch watch(openingTold(settings));
  options.watch = &watch;
  wrappingOf(path, &options.path);
  bytes = unwrapped(watch.watched(std::move(bytes)));
  if (!format.reads_pipes) bytes = makeSeekable(std::move(bytes), options.temp_dir);
  std::shared_ptr<Waiting> waiting = bytes->waiting();
  const std::string name = bytes->name();
  if (bytes->seekable() && bytes->size() == 0) fail(Status::kBadData, "%s: is empty", name.c_str());
  reader.input = format.open(std::move(bytes), options);
  checkUses(reader.input, options, name);
  if (run.cells_to_points == "yes") takeCellsToPoints(reader.input, run.temp_dir, name);
  const std::string unmeasured = unmeasuredNote(reader.input);
  if (!unmeasured.empty()) options.note(name + ": " + unmeasured);
  reader.input.stays_with_caller = false;
  reader.input.waiting = std::move(waiting);
  reader.input.name = name;
  openReader(reader);
}

tetstream_status tetstream_reader_create(const tetstream_reader_callbacks* callbacks,
                                         tetstream_reader** reader) {
  return guardCreate(__func__, reader, [&](tetstream_reader& r) {
    auto source = std::make_unique<CallbackSource>(readStruct(callbacks, "callbacks"));
    r.callbacks = source.get();
    r.input.stream = std::move(source);
  });
}

// The three below are two functions each, with options and without; `function` is the caller's
// name.
static tetstream_status openFileFor(const char* function, const char* path, const char* format,
                                    const tetstream_options* options, tetstream_reader** reader) {
  return guardCreate(function, reader, [&](tetstream_reader& r) {
    needPlace(path, "path");
    const Format& found = needFormat(textOrEmpty(format), path);
    openBytes(r, found, openFile(path), options, path);
  });
}

tetstream_status tetstream_reader_open_file_with(const char* path, const char* format,
                                                 const tetstream_options* options,
                                                 tetstream_reader** reader) {
  return openFileFor(__func__, path, format, options, reader);
}

tetstream_status tetstream_reader_open_file(const char* path, const char* format,
                                            tetstream_reader** reader) {
  return openFileFor(__func__, path, format, nullptr, reader);
}

// What a result is read without, attempt by attempt: nothing, a step, what makes points and fields
// of an indexed mesh, both, and all that says how a file is read.
static constexpr int kLastAttempt = 4;

static bool isLeftOut(const OptionRow& row, int attempt) {
  if (attempt == kLastAttempt) return row.scope == TETSTREAM_SCOPE_READ;
  if (row.id == TETSTREAM_OPTION_STEP) return (attempt & 1) != 0;
  const bool makes =
      row.id == TETSTREAM_OPTION_JOIN_POINTS || row.id == TETSTREAM_OPTION_CELLS_TO_POINTS;
  return makes && (attempt & 2) != 0;
}

tetstream_status tetstream_reader_open_result(const char* path, const char* format,
                                              const tetstream_options* options,
                                              tetstream_reader** reader) {
  if (reader) *reader = nullptr;
  // What is no file is read once, as it is.
  struct stat info;
  const bool is_file = path && ::stat(path, &info) == 0 && S_ISREG(info.st_mode);
  for (int attempt = is_file ? 0 : kLastAttempt;; ++attempt) {
    tetstream_options kept;
    const tetstream_status prepared = guard([&] {
      if (options) kept.values = options->values;
      if (options) kept.state = options->state;
      for (int32_t i = 0; kept.values && i < optionCount(); ++i)
        if (isLeftOut(optionRow(i), attempt)) kept.values->reset(optionRow(i));
    });
    if (prepared != TETSTREAM_OK) return prepared;
    const tetstream_status status =
        openFileFor(__func__, path, format, options ? &kept : nullptr, reader);
    if (status != TETSTREAM_UNSUPPORTED || attempt == kLastAttempt || !options) return status;
    tetstream_reader_destroy(std::exchange(*reader, nullptr));
  }
}

static tetstream_status openDescriptorFor(const char* function, int32_t fd, const char* format,
                                          const tetstream_options* options,
                                          tetstream_reader** reader) {
  return guardCreate(function, reader, [&](tetstream_reader& r) {
    needPlace(format, "format");
    const Format& found = needFormat(format, "");
    openBytes(r, found, openDescriptor(fd, descriptorName(fd)), options);
  });
}

tetstream_status tetstream_reader_open_fd_with(int32_t fd, const char* format,
                                               const tetstream_options* options,
                                               tetstream_reader** reader) {
  return openDescriptorFor(__func__, fd, format, options, reader);
}

tetstream_status tetstream_reader_open_fd(int32_t fd, const char* format,
                                          tetstream_reader** reader) {
  return openDescriptorFor(__func__, fd, format, nullptr, reader);
}

static tetstream_status openMemoryFor(const char* function, const void* data, size_t size,
                                      const char* format, const tetstream_options* options,
                                      tetstream_reader** reader) {
  return guardCreate(function, reader, [&](tetstream_reader& r) {
    needPlace(format, "format");
    if (size > 0) needPlace(data, "data");
    const Format& found = needFormat(format, "");
    openBytes(r, found, openMemory(data, size, "memory"), options);
  });
}

tetstream_status tetstream_reader_open_memory_with(const void* data, size_t size,
                                                   const char* format,
                                                   const tetstream_options* options,
                                                   tetstream_reader** reader) {
  return openMemoryFor(__func__, data, size, format, options, reader);
}

tetstream_status tetstream_reader_open_memory(const void* data, size_t size, const char* format,
                                              tetstream_reader** reader) {
  return openMemoryFor(__func__, data, size, format, nullptr, reader);
}

tetstream_status tetstream_reader_open_mesh(const tetstream_stream_info* info,
                                            const tetstream_batch* mesh,
                                            tetstream_reader** reader) {
  return guardCreate(__func__, reader, [&](tetstream_reader& r) {
    tetstream_stream_info stream = readStruct(info, "info");
    MemorySource::Ids ids;
    ids.first = (stream.flags & TETSTREAM_STREAM_FROM_ONE) != 0 ? 1 : 0;
    stream.flags &= ~static_cast<uint32_t>(TETSTREAM_STREAM_FROM_ONE);
    const Schema schema = schemaOf(stream);
    tetstream_batch batch = readStruct(mesh, "mesh");
    batch.last_uses = nullptr;
    batch.finalized_count = 0;
    if (batch.cells && batch.cells32)
      fail(Status::kBadArgument, "mesh: of cells and cells32 both are given");
    ids.narrow_cells = batch.cells32;
    const BatchView view = BatchChecker(schema).viewMesh(batch);
    r.input.indexed = std::make_unique<MemorySource>(schema, view, ids);
    r.input.stays_with_caller = false;
    openReader(r);
  });
}

tetstream_status tetstream_reader_generate(const char* kind, int64_t cells, int64_t seed,
                                           tetstream_reader** reader) {
  return guardCreate(__func__, reader, [&](tetstream_reader& r) {
    needPlace(kind, "kind");
    r.input.stream = generate(kind, cells, seed);
    r.input.stays_with_caller = false;
    openReader(r);
  });
}

void tetstream_reader_destroy(tetstream_reader* reader) {
  destroy(reader);
}

tetstream_status tetstream_reader_get_info(tetstream_reader* reader, tetstream_stream_info* info) {
  return guard(__func__, reader, [&](tetstream_reader& r) {
    checkStruct(info, "info");
    if (r.state == State::kReady) openReader(r);
    if (!r.known) failState(r.kNoun, r.state);
    writeStruct(info, (r.inspected ? r.inspected : r.known)->info());
  });
}

const char* tetstream_reader_note(const tetstream_reader* reader, int32_t index) {
  return reader ? reader->notes.at(index) : nullptr;
}

tetstream_status tetstream_reader_get_front(tetstream_reader* reader, tetstream_front_info* front) {
  return guard(__func__, reader, [&](tetstream_reader& r) {
    checkStruct(front, "front");
    if (!r.inspected) fail(Status::kBadState, "the reader was not inspected");
    writeStruct(front, r.front);
  });
}

tetstream_status tetstream_reader_get_face_label(tetstream_reader* reader, int32_t index,
                                                 tetstream_face_label_info* label) {
  return guard(__func__, reader, [&](tetstream_reader& r) {
    checkStruct(label, "label");
    if (!r.inspected) fail(Status::kBadState, "the reader was not inspected");
    if (index < 0 || static_cast<size_t>(index) >= r.face_labels.size())
      fail(Status::kBadArgument, "there is no label of faces %d, there are %zu", index,
           r.face_labels.size());
    writeStruct(label, r.face_labels[static_cast<size_t>(index)]);
  });
}

const char* tetstream_reader_message(const tetstream_reader* reader) {
  return messageOf(reader);
}
