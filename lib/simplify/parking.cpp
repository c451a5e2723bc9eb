#include "parking.h"

#include "schema.h"

namespace tetstream {

// By less than the least there is nothing to gain; by more than the most it takes more time than it
// gains. RMS errors and times beside those of windows alone, of isabel and 3e6 cells of `fluid` and
// of `ball`: 1.4 times the target 0.94, in 1.15 times the time, at 0.1; four times it 0.92 and 0.94
// in as much time at 0.02, 0.88 and 0.94 at 0.01, where windows need no passes on the way to their
// bounds then (budget.cpp).
constexpr double kLeastTimes = 1.25, kMostTimes = 4;
// Of the stream's cells, that windows leave though it be more, as far as that many may be parked:
// the less they leave the more is lost, and to simplify so few further takes next to no time. At
// 0.001, 0.004 and 0.01 four times the target had 1.5 to 10, 1.05 to 1.8 and 1.02 to 1.03 times the
// error (isabel, and 1.2e6 cells with a peak, twelve of them, a front and waves).
constexpr double kLeastLeft = 0.05;

// With high effort streams of more cells gain by it what they take longer.
constexpr int64_t kEffort = 4;
// Times what the windows should leave, that cannot be what was planned.
constexpr int64_t kGrossly = 2;
// With fewer cells to a vertex the mesh is of bodies of a few cells each: every one keeps a cell,
// and their vertices would take several times the memory.
constexpr int64_t kLeastCellsToVertex = 2;

static int64_t plannedCells(const SimplifyOptions& options) {
  return options.effort == Effort::kHigh ? kEffort * options.parked_cells : options.parked_cells;
}

int64_t mostParked(const SimplifyOptions& options) {
  return kGrossly * plannedCells(options);
}

// Cells that leave early, to bound the memory or the front of the output, are asked for.
static bool mayPark(const SimplifyOptions& options) {
  return !followsPaper(options.mode) && !options.uniform_ratio && !(options.error > 0) &&
         options.memory_bytes == 0 && options.release == ReleaseOrder::kArrival;
}

double parkedTimes(const Schema& schema, const SimplifyOptions& options, int64_t window,
                   const Pilot& pilot) {
  if (!mayPark(options) || pilot.bound > 0) return 1;
  if (options.parked_times > 0) return options.parked_times;
  const int64_t cells = schema.cell_count;
  if (options.window_cells > 0 || cells <= window) return 1;
  if (schema.vertex_count > cells / kLeastCellsToVertex) return 1;
  const int64_t wanted = targetOf(schema, options).cellsOf(cells);
  if (!isMoreThan(cells, kStrongReduction, wanted)) return 1;
  const double times = static_cast<double>(plannedCells(options)) / static_cast<double>(wanted);
  const double to_least = kLeastLeft * static_cast<double>(cells) / static_cast<double>(wanted);
  return times < kLeastTimes ? 1 : std::min(times, std::max(kMostTimes, to_least));
}

}  // namespace tetstream
