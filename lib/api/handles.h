// api: what the opaque handles hold. Depends on run.h, registry.h, option_values.h, callbacks.h.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "callbacks.h"
#include "compare.h"
#include "guard.h"
#include "notes.h"
#include "option_values.h"
#include "output.h"
#include "rounding_source.h"
#include "spooled_mesh.h"
#include "structs.h"
#include "tasks.h"
#include "traces.h"

struct tetstream_options : tetstream::Handle {
  static constexpr const char* kNoun = "handle of options";
  std::optional<tetstream::OptionValues> values;
};

struct tetstream_reader : tetstream::Handle {
  static constexpr const char* kNoun = "reader";
  std::shared_ptr<tetstream::Workers> workers;    // of the options
  std::unique_ptr<const tetstream::Tasks> tasks;  // that help to read the input
  tetstream::Input input;
  tetstream::CallbackSource* callbacks = nullptr;  // input.stream, where that is the caller's
  std::unique_ptr<const tetstream::PublicSchema> known;
  std::unique_ptr<const tetstream::PublicSchema> inspected;
  tetstream_front_info front = {};                     // once inspected
  std::vector<tetstream_face_label_info> face_labels;  // likewise
  tetstream::Notes notes;
};

struct tetstream_writer : tetstream::Handle {
  static constexpr const char* kNoun = "writer";
  std::shared_ptr<tetstream::Output> output;
  tetstream::LayoutReport laid_out;
};

struct tetstream_simplifier : tetstream::Handle {
  static constexpr const char* kNoun = "simplifier";
  tetstream::RunOptions options;
  std::shared_ptr<tetstream::Workers> workers;  // of the options
  // Shared with the writer, so that the handles can be destroyed in any order.
  std::shared_ptr<tetstream::Output> output;
  tetstream_progress_callback progress = nullptr;
  void* progress_user = nullptr;
  // Not asked for: null. They outlive the run, which borrows them, and close when it is over.
  std::unique_ptr<tetstream::MapSink> map;
  std::unique_ptr<tetstream::LogSink> log;
  std::unique_ptr<tetstream::SimplifyRun> run;
  std::optional<tetstream::BatchChecker> batches;  // of a push stream
  std::optional<tetstream::Rounding> rounding;     // of a push stream
  mutable tetstream::Report report;
  mutable bool reported = false;  // the report is the one of the stream as it is
};

struct tetstream_diagram : tetstream::Handle {
  static constexpr const char* kNoun = "diagram";
  tetstream::RunOptions options;
  std::shared_ptr<tetstream::Workers> workers;  // of the options
  tetstream::DiagramSize size = {};
  tetstream::Diagram diagram;                   // once it was read
  std::vector<int64_t> widths, lowest, newest;  // per column
};

struct tetstream_comparison : tetstream::Handle {
  static constexpr const char* kNoun = "comparison";
  tetstream::RunOptions options;
  std::shared_ptr<tetstream::Workers> workers;   // of the options
  std::unique_ptr<tetstream::Comparison> found;  // once both meshes were read
  double seconds = 0;
};

namespace tetstream {

// Throws kBadState if the writer could not be created.
Output& outputOf(const tetstream_writer& writer);
// Throws unless the reader can be read from: kBadArgument for none, with the argument's name.
void needUnread(const tetstream_reader* reader, const char* argument);

// The caller's reader is opened and what is known of its stream stored. Then and at once for all
// others, `known` is set.
void openReader(tetstream_reader& reader);

// One reading of a reader: throws kBadState unless it is the first. When it ends, the reader's
// input is closed; it has finished if done() was called, and failed otherwise.
class ReaderUse {
 public:
  explicit ReaderUse(tetstream_reader& reader);
  ~ReaderUse();
  ReaderUse(const ReaderUse&) = delete;
  ReaderUse& operator=(const ReaderUse&) = delete;

  // What to read; an indexed mesh that comes in the caller's batches is collected first, in
  // temporary files. With `rounded`, its floats are float32.
  Input& input(bool rounded, const std::string& temp_dir);
  // For the run that reads: `progress`, which is called once more and again, with what it was told
  // last, while somebody at the other end is waited for.
  ProgressFunction told(const ProgressFunction& progress);
  const Schema& schema() const { return reader_.input.schema(); }
  void done() { done_ = true; }

 private:
  tetstream_reader& reader_;
  Input collected_, rounded_;
  std::shared_ptr<Waiting> waiting_;  // where progress is told meanwhile
  bool done_ = false;
};

// True while a handle is inside a call that runs callbacks.
class Busy {
 public:
  explicit Busy(Handle& handle) : handle_(handle) { handle_.busy = true; }
  ~Busy() { handle_.busy = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  Handle& handle_;
};

// Empty if there is no callback.
ProgressFunction progressOf(tetstream_progress_callback callback, void* user);

// The options of a handle; the defaults for NULL. Throws kBadState.
RunOptions runOptionsOf(const tetstream_options* options);
// The same for a handle that outlives them: their workers live as long as it does.
template <class H>
void keepOptions(H& handle, const tetstream_options* options) {
  handle.options = runOptionsOf(options);
  if (options) handle.workers = options->values->workers();
}

}  // namespace tetstream
