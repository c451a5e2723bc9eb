#include "label_volumes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "status.h"

namespace tetstream {

constexpr double kLeastChange = 0.01;
constexpr size_t kNamed = 3;
constexpr size_t kMostRegions = 10000;  // further ones are not looked at: memory has a bound

// Null where there are too many.
auto LabelVolumes::volumesOf(const CellLabels& labels, uint32_t cell) -> Volumes* {
  const Labelled labelled = {labels, labels.rowOf(cell)};
  if (last_ && Less::compare(last_->first, labelled) == 0) return &last_->second;
  auto found = all_.find(labelled);
  if (found == all_.end()) {
    if (all_.size() == kMostRegions) return nullptr;
    Row row;
    for (int i = 0; i < labels.count; ++i) row.push_back(labelled.row[labels.columns[i]]);
    found = all_.emplace(std::move(row), Volumes{}).first;
  }
  last_ = &*found;
  return &found->second;
}

void LabelVolumes::add(const CellLabels& labels, uint32_t cell, double volume, Side side) {
  if (Volumes* const volumes = volumesOf(labels, cell)) volumes->of[side] += volume;
}

int LabelVolumes::Less::compare(const Row& a, const Labelled& b) {
  for (size_t i = 0; i < a.size(); ++i) {
    const int64_t other = b.row[b.labels.columns[i]];
    if (a[i] != other) return a[i] < other ? -1 : 1;
  }
  return 0;
}

auto LabelVolumes::find(const CellLabels& labels, const int64_t* row) const -> const Volumes* {
  const auto found = all_.find(Labelled{labels, row});
  return found == all_.end() ? nullptr : &found->second;
}

static std::string nameOf(const std::vector<int64_t>& row) {
  std::string name;
  for (int64_t label : row)
    name += textOf("%s%lld", name.empty() ? "" : "/", static_cast<long long>(label));
  return name;
}

std::string LabelVolumes::changesInWords() const {
  std::vector<std::pair<double, const Row*>> changes;
  for (const auto& [row, volumes] : all_)
    if (std::fabs(volumes.change()) > kLeastChange) changes.emplace_back(volumes.change(), &row);
  if (changes.empty()) return "";
  std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) {
    return std::fabs(a.first) > std::fabs(b.first);
  });
  std::string text =
      textOf("%zu of %s%zu regions changed their volume by more than 1 %%:", changes.size(),
             all_.size() == kMostRegions ? "the first " : "", all_.size());
  for (size_t i = 0; i < std::min(changes.size(), kNamed); ++i)
    text += textOf("%s %s by %+.3g %%", i == 0 ? "" : ",", nameOf(*changes[i].second).c_str(),
                   100 * changes[i].first);
  return text + (changes.size() > kNamed ? ", ..." : "");
}

}  // namespace tetstream
