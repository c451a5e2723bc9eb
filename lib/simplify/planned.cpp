// simplify: what is known of a run before it begins. See simplifier.h.
#include <utility>

#include "simplifier.h"
#include "target.h"
#include "window_size.h"

namespace tetstream {

static WindowSize sizeOf(const Plan& plan, const SimplifyOptions& options) {
  return plan.double_window ? windowSize<double>(plan, options) : windowSize<float>(plan, options);
}

// A budget with room for so many is ample. note: whatever the number of threads, on which no result
// may depend.
constexpr int64_t kAmplePatches = 2;

SimplifyOptions Simplifier::planned(const Schema& schema, const SimplifyOptions& options) {
  const Plan plan = makePlan(schema, carryingTooMany(schema, options));
  SimplifyOptions planned = options;
  const int64_t patches = sizeOf(plan, options).sparePatches();
  if (patches < kAmplePatches) return planned;
  planned.limit_bytes = std::exchange(planned.memory_bytes, 0);
  planned.most_threads = static_cast<size_t>(patches);
  return planned;
}

int64_t Simplifier::windowCells(const Schema& schema, const SimplifyOptions& options) {
  const Plan plan = makePlan(schema, carryingTooMany(schema, options));
  return sizeOf(plan, options).first();
}

int64_t Simplifier::targetCells(const Schema& schema, const SimplifyOptions& options) {
  return targetOf(schema, options).cellsOf(schema.cell_count);
}

std::vector<bool> Simplifier::measuredFields(const Schema& schema, const SimplifyOptions& options) {
  const Plan plan = makePlan(schema, options);
  std::vector<bool> measured;
  for (const ColumnPlan& field : plan.fields)
    measured.push_back(field.treatment == Treatment::kMeasured);
  return measured;
}

}  // namespace tetstream
