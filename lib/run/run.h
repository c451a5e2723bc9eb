// run: joins reader, layout, simplifier and writer. Depends on layout, simplify, draw, measure,
// format, stream.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "compare_options.h"
#include "face_labels.h"
#include "layout_diagram.h"
#include "options.h"
#include "source.h"
#include "sweep_views.h"
#include "traces.h"
#include "workers.h"

namespace tetstream {

struct RunOptions {
  SimplifyOptions simplify;
  std::string order = "auto";  // of input: see orders.h
  // What "auto" does: leaves streams as they are; orders those whose front is wide, too, in a
  // sweep, whose smooth front serves a simplification best; or in what has the narrowest front.
  enum class Auto { kKeeps, kSweeps, kNarrows } automatic = Auto::kSweeps;
  std::string axis = "auto";  // of order "spatial"
  std::string temp_dir;
  int64_t threads = 0;         // at work at once; 0: one for each core that the process may use
  Workers* workers = nullptr;  // that were brought; null: threads of our own
  std::string split = "no";    // of other cells, when a file is read
  std::string cells_to_points = "no";  // likewise
  std::string join_points = "auto";    // likewise
  std::string recover = "no";          // what is whole of a damaged file
  std::string step = "last";           // time step, likewise
  bool origins = false;                // ordered vertices tell their ranks in the input
  CompareOptions compare;
};

// How many threads a run uses.
size_t threadsOf(const RunOptions& options);

// One simplification. Pull: run. Push: begin, put as often as wanted, finish; an indexed mesh that
// is pushed is collected first and ordered at finish. Not to be used after an Error.
class SimplifyRun {
 public:
  SimplifyRun(const RunOptions& options, Sink& out, ProgressFunction progress);
  ~SimplifyRun();

  // Before the stream begins: where to tell what became of the vertices.
  void trace(TraceSinks sinks);

  void run(Input& input);

  void begin(const Schema& schema, bool indexed);
  void put(const BatchView& batch);
  void finish();

  Report report() const;  // what was done so far

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// What bringing a mesh into an order came to.
struct LayoutReport {
  std::string order;  // and why
  int64_t vertices = 0, cells = 0, unused_vertices = 0;
  int64_t front_width = 0, front_span = 0, front_cells = 0;
  uint64_t temporary_bytes = 0;  // of disk at once, at most
  double seconds = 0;
};

// Copies a mesh, ordering it on the way if it is indexed or an order is asked for.
LayoutReport convert(Input& input, Sink& out, const RunOptions& options,
                     const ProgressFunction& progress);

// What a mesh is like, as it would be streamed.
struct Inspection {
  Schema schema;                    // with everything known: counts, box, front
  DiagramFigures figures;           // means and lifetimes
  int64_t window_cells;             // that a simplification takes
  std::vector<int64_t> not_finite;  // values of each field
  int64_t unused_vertices;          // in no cell, left out
  FaceLabels face_labels;           // without areas
};
// Reads the whole input.
Inspection inspect(Input& input, const RunOptions& options, const ProgressFunction& progress);

// What the pages about a stream's layout are drawn from.
struct Diagram {
  std::unique_ptr<LayoutDiagram> layout;
  std::unique_ptr<SweepViews> sweep;  // null if not asked for
};

struct DiagramSize {
  size_t columns, rows;
};

// Reads the whole input, as inspect does. A sweep needs the box and the number of cells beforehand:
// where the stream does not tell them, it is read twice; throws kUnsupported where it cannot be.
Diagram readDiagram(Input& input, DiagramSize size, bool with_sweep, const RunOptions& options,
                    const ProgressFunction& progress);

}  // namespace tetstream
