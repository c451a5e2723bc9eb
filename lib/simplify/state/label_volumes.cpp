#include "label_volumes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "status.h"

namespace tetstream {

constexpr double kLeastChange = 0.01;
constexpr size_t kNamed = 3;
constexpr size_t kMostRegions = 10000;  // further ones are not looked at: memory has a bound

// Null where there are too many.
auto LabelVolumes::volumesOf(const CellLabels& labels, uint32_t cell) -> Volumes* {
  const int64_t* const row = labels.rowOf(cell);
  bool is_same = last_ != nullptr;
  for (size_t i = 0; is_same && i < row_.size(); ++i) is_same = row_[i] == row[labels.columns[i]];
  if (is_same) return last_;
  row_.clear();
  for (int i = 0; i < labels.count; ++i) row_.push_back(row[labels.columns[i]]);
  auto found = all_.find(row_);
  if (found == all_.end() && all_.size() < kMostRegions)
    found = all_.emplace(row_, Volumes{}).first;
  return last_ = found == all_.end() ? nullptr : &found->second;
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

double LabelVolumes::inputOf(const CellLabels& labels, const int64_t* row) const {
  const auto found = all_.find(Labelled{labels, row});
  return found == all_.end() ? std::numeric_limits<double>::infinity() : found->second.of[kInput];
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
