// simplify: a stream in, a smaller stream out, through a bounded window. Depends on stream, mesh,
// quadric. The page to read first is simplifier.cpp.
#pragma once

#include <memory>

#include "options.h"
#include "pilot.h"
#include "source.h"
#include "traces.h"

namespace tetstream {

// A Sink that feeds a Sink. Not to be used after an Error.
class Simplifier : public Sink {
 public:
  Simplifier(const SimplifyOptions& options, Sink& out, ProgressFunction progress);
  ~Simplifier() override;
  void begin(const Schema& schema) override;
  void put(const BatchView& batch) override;
  void finish() override;

  Report report() const;  // what was done so far

  // Cells of the window that a stream would get; of one with too many fields to be measured, if all
  // were carried: a user has to name those that matter.
  static int64_t windowCells(const Schema& schema, const SimplifyOptions& options);
  // Cells that its target leaves of a stream that says its count.
  static int64_t targetCells(const Schema& schema, const SimplifyOptions& options);
  // Which fields are measured. Throws kBadArgument for some that the stream does not have.
  static std::vector<bool> measuredFields(const Schema& schema, const SimplifyOptions& options);
  // Those that a run goes by: a budget that is ample for the stream is but a limit.
  static SimplifyOptions planned(const Schema& schema, const SimplifyOptions& options);
  // Before begin: what is known of the stream from an earlier run.
  void follow(Pilot pilot) { pilot_ = std::move(pilot); }
  // Before begin: where to tell what became of the vertices.
  void trace(TraceSinks sinks) { sinks_ = sinks; }
  // After finish, of a run whose window held all cells.
  Pilot pilot() const;

  // The loop for one scalar type. Internal.
  class Engine {
   public:
    virtual ~Engine() = default;
    virtual void put(const BatchView& batch) = 0;
    virtual void finish() = 0;
    virtual Report report() const = 0;
    virtual Pilot pilot() const = 0;
  };

 private:
  SimplifyOptions options_;
  Sink& out_;
  ProgressFunction progress_;
  Pilot pilot_;
  TraceSinks sinks_;
  std::unique_ptr<Engine> engine_;
};

}  // namespace tetstream
