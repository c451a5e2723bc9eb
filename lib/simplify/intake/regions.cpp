#include "regions.h"

#include <cmath>
#include <numeric>

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
    if (wish == "auto" && isFloat(columns[i].type)) continue;
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
bool Regions<S>::isScattered(int offset, int components,
                             const std::vector<CellPair>& neighbours) const {
  std::vector<int> columns(static_cast<size_t>(components));
  std::iota(columns.begin(), columns.end(), offset);
  CellLabels labels = core_.cellLabels();
  labels.columns = columns.data();
  labels.count = components;
  return areScattered(labels, neighbours);
}

static void add(std::string* names, const std::string& name) {
  *names += (names->empty() ? "" : ", ") + name;
}

template <class S>
void Regions<S>::decide() {
  decided_ = true;
  const bool is_auto = core_.options.regions == "auto";
  std::string taken, ids, scattered;
  std::vector<CellPair> neighbours;  // once they are needed
  for (int column : columns_) {
    const Column& c = core_.plan.schema.cell_data[static_cast<size_t>(column)];
    const int offset = core_.plan.cell_data[static_cast<size_t>(column)].offset;
    const bool is_id = is_auto && looksLikeIds(offset, c.components);
    if (is_auto && !is_id && neighbours.empty()) neighbours = someNeighbours(core_.window.mesh);
    if (is_id) {
      add(&ids, c.name);
    } else if (is_auto && isScattered(offset, c.components, neighbours)) {
      add(&scattered, c.name);
    } else {
      add(&taken, c.name);
      for (int i = 0; i < c.components; ++i) core_.region_picks.push_back(offset + i);
    }
  }
  core_.report.regions = taken.empty() ? "none" : "by " + taken;
  if (!ids.empty()) core_.report.regions += " (" + ids + ": few cells to a label, taken as ids)";
  if (!scattered.empty())
    core_.report.regions += " (" + scattered + ": other labels from cell to cell, not taken)";
  if (!partitions_.empty())
    core_.report.regions += " (" + partitions_ + ": parts of a parallel run by name, not taken)";
}

template class Regions<float>;
template class Regions<double>;

}  // namespace tetstream
