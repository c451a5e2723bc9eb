#include "handles.h"

namespace tetstream {

void needUnread(const tetstream_reader* reader, const char* argument) {
  needPlace(reader, argument);
  needCreated(*reader);
  needState(*reader, State::kReady);
}

Output& outputOf(const tetstream_writer& writer) {
  needCreated(writer);
  if (!writer.output) failState(writer.kNoun, writer.state);
  return *writer.output;
}

static void closeInput(tetstream_reader& reader) noexcept {
  reader.callbacks = nullptr;
  reader.input.stream.reset();
  reader.input.indexed.reset();
}

void openReader(tetstream_reader& reader) {
  if (reader.known) return;
  try {
    const Busy busy(reader);
    if (reader.callbacks) reader.callbacks->open();
    const bool indexed = reader.input.indexed || (reader.callbacks && reader.callbacks->indexed());
    reader.known = std::make_unique<const PublicSchema>(reader.input.schema(), indexed);
  } catch (...) {
    closeInput(reader);
    reader.state = State::kBroken;
    throw;
  }
}

ReaderUse::ReaderUse(tetstream_reader& reader) : reader_(reader) {
  needState(reader, State::kReady);
  openReader(reader);
  reader.state = State::kRunning;
  reader.busy = true;
}

Input& ReaderUse::input(bool rounded, const std::string& temp_dir) {
  Input* input = &reader_.input;
  if (reader_.callbacks && reader_.callbacks->indexed()) {
    collected_.indexed = spoolStream(*input->stream, temp_dir, [](double) {});
    collected_.stays_with_caller = false;
    input = &collected_;
  }
  if (!rounded) return *input;
  rounded_.stays_with_caller = input->stays_with_caller;
  rounded_.waiting = input->waiting;
  rounded_.name = input->name;
  if (input->stream) rounded_.stream = std::make_unique<RoundingSource>(*input->stream);
  if (input->indexed) rounded_.indexed = std::make_unique<RoundingIndexedSource>(*input->indexed);
  return rounded_;
}

ProgressFunction ReaderUse::told(const ProgressFunction& progress) {
  if (!progress || !reader_.input.waiting) return progress;
  waiting_ = reader_.input.waiting;
  const auto last = std::make_shared<Progress>();
  last->phase = "open";
  waiting_->doMeanwhile([progress, last] { progress(*last); });
  return [progress, last](const Progress& now) {
    *last = now;
    progress(now);
  };
}

ReaderUse::~ReaderUse() {
  if (waiting_) waiting_->doMeanwhile({});
  closeInput(reader_);
  reader_.busy = false;
  reader_.state = done_ ? State::kFinished : State::kBroken;
}

ProgressFunction progressOf(tetstream_progress_callback callback, void* user) {
  if (!callback) return {};
  return [callback, user](const Progress& progress) {
    tetstream_progress shown = {};
    shown.struct_size = sizeof shown;
    shown.cells_read = progress.cells_read;
    shown.cells_total = progress.cells_total;
    shown.cells_written = progress.cells_written;
    shown.fraction = progress.fraction;
    shown.phase = progress.phase;
    shown.temporary_bytes = progress.temporary_bytes;
    int32_t value = 0;
    try {
      value = callback(user, &shown);
    } catch (...) {
      fail(Status::kCallback, "an exception left the progress callback");
    }
    if (value != 0) fail(Status::kCancelled, "the progress callback returned %d", value);
  };
}

RunOptions runOptionsOf(const tetstream_options* options) {
  if (!options) return OptionValues().runOptions();
  needCreated(*options);
  return options->values->runOptions();
}

}  // namespace tetstream
