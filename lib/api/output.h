// api: where one stream goes: the part of a writer that outlives its handle while a simplifier
// still uses it. Depends on registry.h, callbacks.h.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "callbacks.h"
#include "guard.h"
#include "joint_files.h"
#include "notes.h"
#include "options.h"
#include "registry.h"

namespace tetstream {

// The row of a format, by its name or the path's extension; throws kUnsupported if it is not
// written.
const Format& writtenFormat(const std::string& name, const std::string& path);

// The states: kReady, kRunning from start to complete, then kFinished; kBroken and kDestroyed
// close everything that was open, and leave nothing under a final name.
class Output final : public Sink {
 public:
  explicit Output(const tetstream_writer_callbacks& callbacks);
  Output(const Format& format, const std::string& path);
  Output(const Format& format, std::unique_ptr<ByteSink> bytes);
  explicit Output(const Format& format);  // into memory
  // `options_` and the sink point into the object.
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  State state() const { return state_; }
  void needReady() const;  // throw kBadState
  void needRunning() const;
  void set(const std::string& property, const std::string& value);
  const std::vector<unsigned char>& memory() const;  // throws kBadState
  // Note `index`, or null; it lives as long as the output.
  const char* note(int32_t index) const noexcept;
  // The schema cannot be held as it is: its floats must be rounded before anything is decided on
  // them. If so, that is noted.
  bool mustRound(const Schema& schema);

  // Before start: `progress`, or nothing, as a run is to get it. It is called, too, while a file is
  // completed, in a phase "write"; what it throws ends that.
  ProgressFunction watchedBy(ProgressFunction progress);
  // `is_mapped`: as in WriteOptions.
  void start(const std::string& temp_dir, bool is_mapped = false);
  void begin(const Schema& schema) override;
  void put(const BatchView& batch) override { sink().put(batch); }
  void finish() override;
  bool staysWithCaller() const override { return stays_with_caller_; }
  // `rest` is called before what is put into goes while the output runs: nobody may put meanwhile.
  void onStop(std::function<void()> rest) { rest_ = std::move(rest); }
  // The files that get their names when the output is complete: its own, and its run's others.
  JointFiles& files() { return files_; }
  void complete();                  // throws kIo
  void stop(State state) noexcept;  // kBroken or kDestroyed, unless it is one of them already

 private:
  Sink& sink();
  void beforeWrite();
  void tellWriting();
  void addNote(const std::string& note);

  State state_ = State::kReady;
  const Format* format_ = nullptr;  // null: callbacks
  tetstream_writer_callbacks callbacks_ = {};
  bool in_memory_ = false;
  std::vector<unsigned char> memory_;
  JointFiles files_;
  std::unique_ptr<ByteSink> bytes_;
  WriteOptions options_;
  bool stays_with_caller_ = true;
  mutable std::mutex noting_;  // notes may come while the caller looks at them
  Notes notes_;
  std::unique_ptr<Sink> sink_;
  std::function<void()> rest_;
  ProgressFunction progress_;
  Progress told_;  // last
  TellingPause pause_;
  std::atomic<std::thread::id> finishing_ = {};  // who completes the file; others may write before
};

}  // namespace tetstream
