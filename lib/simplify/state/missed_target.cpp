#include "missed_target.h"

#include "status.h"

namespace tetstream {

static std::string keptInWords(const LockedVertices& locked) {
  std::string kept;
  const auto name = [&kept](int64_t count, const char* what) {
    if (count > 0)
      kept += textOf("%s%lld %s", kept.empty() ? "" : ", ", static_cast<long long>(count), what);
  };
  name(locked.corners, "vertices where interfaces or their curves end, branch or touch");
  name(locked.non_manifold, "vertices at non-manifold places of the boundary");
  name(locked.bad_cells, "flat or folded cells of the input");
  name(locked.by_caller, "vertices locked by the stream");
  return kept;
}

// Of the cell arrays that label regions.
template <class S>
static std::string regionArrays(const Core<S>& core) {
  std::string names;
  for (size_t i = 0; i < core.plan.cell_data.size(); ++i)
    for (const int pick : core.region_picks)
      if (core.plan.cell_data[i].treatment == Treatment::kPicked &&
          core.plan.cell_data[i].offset == pick)
        names += (names.empty() ? "" : ", ") + core.plan.schema.cell_data[i].name;
  return names;
}

// Rounded down: errors are as large and more.
static const char* sizeInWords(double percent) {
  if (percent >= 100) return "as large as";
  if (percent >= 50) return "of half of";
  if (percent >= 20) return "of a fifth of";
  return percent >= 10 ? "of a tenth of" : "of a hundredth of";
}

template <class S>
std::string missInWords(const Core<S>& core) {
  const Report& report = core.report;
  std::string text = "no legal collapse is left";
  if (core.tally.rejected_large > 0)
    text += textOf(" but with errors %s the %s and more", sizeInWords(core.most_percent),
                   core.plan.measures() ? "range of the fields" : "extent of the mesh");
  if (report.window_cells < 2 * report.front_cells && !core.holdsAll())
    text += textOf(
        "; the window of %lld cells is less than two fronts of %lld: give it more cells or "
        "memory",
        static_cast<long long>(report.window_cells), static_cast<long long>(report.front_cells));
  if (core.interfaces)
    text += "; the interfaces of regions by " + regionArrays(core) +
            " are kept, unless there are to be no regions (option regions, --regions none)";
  const std::string kept = keptInWords(core.locked);
  if (!kept.empty()) text += "; kept as they are: " + kept;
  text += textOf(
      "; refused: %lld collapses that would turn a cell over or flatten it, %lld that would change "
      "the topology or push the boundary through itself",
      static_cast<long long>(report.rejected_orientation),
      static_cast<long long>(report.rejected_link));
  if (core.tally.rejected_volume > 0)
    text += textOf(", %lld that could not keep the volume",
                   static_cast<long long>(core.tally.rejected_volume));
  return text;
}

template std::string missInWords(const Core<float>& core);
template std::string missInWords(const Core<double>& core);

}  // namespace tetstream
