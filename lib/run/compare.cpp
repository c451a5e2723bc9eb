#include "compare.h"

#include <algorithm>
#include <vector>

#include "named_input.h"
#include "ordering.h"

namespace tetstream {

// Shares of the time: the original is read by the first, the other by the second.
constexpr double kOriginalRead = 0.25, kBothRead = 0.3;

ComparePlan comparePlanOf(const RunOptions& options) {
  ComparePlan plan;
  plan.options = options.compare;
  plan.fields = options.simplify.fields;
  plan.regions = options.simplify.regions;
  plan.seed = static_cast<uint64_t>(options.simplify.seed);
  plan.memory_bytes = static_cast<size_t>(options.simplify.memory_bytes);
  plan.temp_dir = options.temp_dir;
  return plan;
}

// Of those that were named; of others that are not finite it is told.
static std::vector<bool> finiteFields(const Comparison& comparison, const ComparePlan& plan,
                                      const Schema& schema) {
  std::vector<bool> compared(schema.fields.size());
  if (plan.fields.empty()) return compared;
  for (const FieldComparison& field : comparison.fields())
    compared[static_cast<size_t>(findColumn(schema.fields, field.name))] = true;
  return compared;
}

std::unique_ptr<Comparison> compareInputs(Input& original, Input& simplified,
                                          const RunOptions& options,
                                          const ProgressFunction& progress) {
  const ComparePlan plan = comparePlanOf(options);
  auto comparison = std::make_unique<Comparison>(original.schema(), simplified.schema(), plan);
  Progress p;
  const auto part = [&](const char* phase, double begin, double end) -> Done {
    return [&p, &progress, phase, begin, end](double share) {
      if (!progress) return;
      p.phase = phase;
      p.fraction = begin + share * (end - begin);
      progress(p);
    };
  };
  RunOptions order = options;
  order.automatic = RunOptions::Auto::kSweeps;
  const size_t memory = plan.memory_bytes > 0 ? plan.memory_bytes : kDefaultCompareMemory;
  order.simplify.memory_bytes = static_cast<int64_t>(std::max<size_t>(memory / 4, 1));
  const auto read = [&](Input& input, const char* phase, double begin, double end, bool first) {
    p.cells_total = input.schema().cell_count;
    const double ordered = begin + (end - begin) / 2;
    const auto tell = part("order", begin, ordered);
    const ProgressFunction ordering = progress ? ProgressFunction([&](const Progress& o) {
      p.temporary_bytes = o.temporary_bytes;
      tell(std::max(o.fraction, 0.0));
    })
                                               : ProgressFunction();
    Ordering stream(input, order, ordering, finiteFields(*comparison, plan, input.schema()));
    const Done done = part(phase, ordered, end);
    if (first)
      comparison->readOriginal(stream.source(), done);
    else
      comparison->readSimplified(stream.source(), done);
  };
  readNamed(original, [&] { read(original, "read original", 0, kOriginalRead, true); });
  readNamed(simplified,
            [&] { read(simplified, "read simplified", kOriginalRead, kBothRead, false); });
  const Tasks tasks(plan.memory_bytes > 0 ? 1 : threadsOf(options), options.workers);
  comparison->measure(&tasks, part("compare", kBothRead, 1));
  return comparison;
}

}  // namespace tetstream
