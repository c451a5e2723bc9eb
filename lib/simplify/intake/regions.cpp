#include "regions.h"

#include <cmath>

#include "id_census.h"
#include "status.h"
#include "vector3.h"

namespace tetstream {

template <class S>
Regions<S>::Regions(Core<S>& core) : core_(core) {
  const std::string& wish = core.options.regions;
  const std::vector<Column>& columns = core.plan.schema.cell_data;
  if (wish == "none") return;
  if (wish != "auto" && findColumn(columns, wish) < 0)
    fail(Status::kBadArgument, "there is no cell array \"%s\" to take as regions", wish.c_str());
  for (size_t i = 0; i < columns.size(); ++i) {
    if (wish != "auto" && columns[i].name != wish) continue;
    if (isFloat(columns[i].type)) {
      if (wish == "auto") continue;
      fail(Status::kBadArgument, "cell array \"%s\" holds no integers: it labels no regions",
           wish.c_str());
    }
    if (wish == "auto" && namesPartition(columns[i].name)) {
      partitions_ += (partitions_.empty() ? "" : ", ") + columns[i].name;
      continue;
    }
    columns_.push_back(static_cast<int>(i));
  }
}

template <class S>
bool Regions<S>::looksLikeIds(int offset, int components) const {
  const uint32_t cells = core_.window.mesh.cellEnd();
  IdCensus census(cells);
  for (uint32_t c = 0; c < cells; ++c) census.add(core_.window.cellPicks(c) + offset, components);
  return census.areIds();
}

template <class S>
void Regions<S>::take(uint32_t first, uint32_t end) {
  if (first == end) return;
  if (!decided_) decide();
  if (core_.region_picks.empty()) return;
  const CellLabels labels = core_.cellLabels();
  for (uint32_t c = first; c < end; ++c) {
    double corners[4][3];
    cornersIn(core_.window, c, corners);
    const double volume = std::fabs(sixVolume(corners)) / 6;
    core_.label_volumes.add(labels, c, volume, LabelVolumes::kInput);
  }
}

template <class S>
void Regions<S>::decide() {
  decided_ = true;
  std::string taken, ids;
  for (int column : columns_) {
    const Column& c = core_.plan.schema.cell_data[static_cast<size_t>(column)];
    const int offset = core_.plan.cell_data[static_cast<size_t>(column)].offset;
    const bool is_id = core_.options.regions == "auto" && looksLikeIds(offset, c.components);
    std::string& list = is_id ? ids : taken;
    list += (list.empty() ? "" : ", ") + c.name;
    for (int i = 0; !is_id && i < c.components; ++i) core_.region_picks.push_back(offset + i);
  }
  core_.report.regions = taken.empty() ? "none" : "by " + taken;
  if (!ids.empty()) core_.report.regions += " (" + ids + ": few cells to a label, taken as ids)";
  if (!partitions_.empty())
    core_.report.regions += " (" + partitions_ + ": parts of a parallel run by name, not taken)";
}

template class Regions<float>;
template class Regions<double>;

}  // namespace tetstream
