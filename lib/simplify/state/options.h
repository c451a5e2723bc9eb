// simplify/state: what the user can ask for and what he is told. Depends on stream.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "schema.h"

namespace tetstream {

class Tasks;

enum class QuadricForm { kDeterminant, kGarlandZhou };
enum class Mode { kSweep, kPaper, kQueue };
// Edges are collapsed in a window with links, one by one, at the same ratio all along the stream.
constexpr bool followsPaper(Mode mode) {
  return mode != Mode::kSweep;
}
enum class PilotUse { kAuto, kNever };
enum class ReleaseOrder { kArrival, kError };
enum class BalanceUse { kAuto, kNever };
enum class FieldRange { kFree, kKeep };
enum class Shape { kField, kSolver };
enum class Effort { kNormal, kHigh };

struct SimplifyOptions {
  // Targets, of which the first that is reached ends the run; 0: not given. Without any, a ratio of
  // 0.1.
  double ratio = 0;   // cells out / cells in
  int64_t cells = 0;  // cells out
  double error = 0;   // RMS error of the measured fields, percent of their range
  bool countsCells() const { return ratio > 0 || cells > 0; }
  std::vector<std::pair<std::string, double>> fields;  // measured, with weights; empty: all with 1
  double boundary_weight = 10;
  BalanceUse balance = BalanceUse::kAuto;  // of the boundary's weight and the fields
  FieldRange field_range = FieldRange::kFree;
  std::string regions = "auto";
  // Degrees by which a sheet bends at least to make a curve; 0: where the boundary folds back.
  double feature_angle = 0;
  Mode mode = Mode::kSweep;
  QuadricForm quadric = QuadricForm::kDeterminant;
  PilotUse pilot = PilotUse::kAuto;
  ReleaseOrder release = ReleaseOrder::kArrival;
  int64_t seed = 1;
  int64_t candidates = 8;
  Shape shape = Shape::kField;
  // High: smaller steps of the bound, flips and prices for thin cells whatever the input has.
  Effort effort = Effort::kNormal;
  int64_t window_cells = 0;          // 0: from the front
  int64_t memory_bytes = 0;          // 0: no limit
  int64_t limit_bytes = 0;           // instead: a budget that is large enough to plan nothing for
  size_t most_threads = ~size_t{0};  // that simplify, under such a limit
  const Tasks* tasks = nullptr;      // for a sweep; null: the caller's thread alone
  // For comparisons, beyond what users are offered.
  double shape_weight = -1;    // of the regulariser; below 0: the mode's
  double balance_ratio = 0;    // of the run that a sample is taken for; 0: this one's
  bool uniform_ratio = false;  // all along the stream, whatever the mode
  int64_t tile_vertices = 0;   // of a patch, at most; 0: what fits the cache and the memory budget
  bool renews = true;          // mode sweep: quadrics, from the cells that are there (renewal.h)
  bool eases_in = true;        // mode sweep: small steps to the goal where few cells are left; a
                               // pilot tells what the steps of a stream come to
  double parked_times = 0;     // mode sweep: of the target, that windows leave for the end
                               // (parking.h); 0: where it is worth it
  int64_t parked_cells = 1 << 18;  // that windows may leave: some 10 MB with one field
  bool tries_again = true;  // mode queue: edges that were refused, once the window has changed
  // Where nothing else is legal: every edge, also at its ends and its midpoint, and thin cells.
  bool last_resort = true;

  // Whether the cell array is the one that was named.
  bool takesAsRegions(const std::string& array) const {
    return regions != "auto" && regions != "none" && array == regions;
  }
};

struct Report {
  int64_t cells_in = 0, vertices_in = 0, cells_out = 0, vertices_out = 0;
  int64_t target_cells = 0, window_cells = 0;
  int64_t front_width = 0, front_span = 0;
  int64_t front_cells = -1;  // as the stream tells it, or as windows met it; -1: neither
  int64_t collapses = 0, flips = 0;
  int64_t rejected_orientation = 0, rejected_link = 0, rejected_locked = 0, rejected_other = 0;
  int64_t locked_cells = 0, unused_vertices = 0;
  double largest_error = 0;
  double volume_in = 0, volume_out = 0;  // sums of the cells' volumes without signs
  double estimated_error = 0;  // RMS, percent of the range, not less than the true one as a rule;
                               // NaN where no field is measured
  double seconds = 0;
  uint64_t peak_window_bytes = 0;
  std::string order;             // how the input was ordered
  std::string regions = "none";  // what was taken as region labels, a sentence
  std::string balance;           // of sheets that count less than asked for, in words; or empty
  std::string reached;     // the target that ended the run: "ratio", "cells", "error"; or empty
  std::string limited_by;  // what stopped the run short of its target; empty: reached
};

struct Progress {
  int64_t cells_read = 0, cells_total = -1, cells_written = 0;
  double fraction = -1;
  const char* phase = "";
  int64_t temporary_bytes = 0;  // of disk that ordering will take, about
};
using ProgressFunction =
    std::function<void(const Progress&)>;  // throws kCancelled to stop; or empty

}  // namespace tetstream
